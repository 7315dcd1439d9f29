/// The JSON Schema of scenario documents, made from the declared parameters: what forms, editors and other programs
/// read.
#include "engine/adversary/attack.hpp"
#include "engine/methods/detectors/detector.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/scenario/scenario.hpp"
#include "engine/scenario/schema_leaf.hpp"
#include "engine/scenario/sections.hpp"
#include "engine/world/controller.hpp"
#include "engine/world/interconnected/waveform.hpp"
#include "engine/world/noise.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil {
namespace {

using schema::leaf;
using schema::object;
using schema::reference;

Json text() { return {{"type", "string"}, {"maxLength", 4096}}; }
Json boolean() { return {{"type", "boolean"}}; }
Json choice(const std::vector<std::string>& words) { return {{"type", "string"}, {"enum", words}}; }

Json tick(int minimum, bool nullable) {
  Json type = "integer";
  if (nullable) type = {"integer", "null"};
  return {{"type", type}, {"minimum", minimum}, {"maximum", 1'000'000'000'000}};
}

/// The ids of one kind, with their titles for the eye.
template <class Make>
Json kinds(const Words& words) {
  Json result = leaf(choice(Registry<Make>::ids()), words);
  for (const auto& entry : Registry<Make>::all()) {
    result["x-labels"][entry.id] = {{"en", entry.title.en}, {"zh", entry.title.zh}};
  }
  return result;
}

/// One definition "<kind>.<id>" for the params of each entry.
template <class Make>
void define(const std::string& kind, Json& definitions) {
  for (const auto& entry : Registry<Make>::all()) {
    Json params = leaf(entry.params.schema(), entry.title);
    params["x-source"] = entry.source;
    definitions[kind + "." + entry.id] = std::move(params);
  }
}

/// [{if key is this id, then params follow its definition}, …]
template <class Make>
Json branches(const std::string& kind, const std::string& key) {
  Json result = Json::array();
  for (const auto& entry : Registry<Make>::all()) {
    const Json condition = {{"properties", {{key, {{"const", entry.id}}}}}, {"required", Json::array({key})}};
    Json then = {{"properties", {{"params", reference(kind + "." + entry.id)}}}};
    bool needs_params = false;
    for (const auto& param : entry.params.all()) needs_params = needs_params || param.required;
    if (needs_params) then["required"] = Json::array({"params"});
    result.push_back({{"if", condition}, {"then", std::move(then)}});
  }
  return result;
}

Json params_slot() { return {{"type", "object"}}; }

template <class Make>
Json typed(const std::string& kind, const Words& words) {
  Json result = object({{"type", kinds<Make>(words)}, {"params", params_slot()}}, Json::array({"type"}));
  result["allOf"] = branches<Make>(kind, "type");
  return leaf(std::move(result), words);
}

Json title() {
  const Json both = object(
      {{"en", leaf(text(), {"English title", "英文标题"})}, {"zh", leaf(text(), {"Chinese title", "中文标题"})}});
  return leaf({{"anyOf", Json::array({both, text()})}}, {"Title", "标题"});
}

Json time() {
  Json length = {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 1e12}, {"x-unit", "s"}};
  return leaf(
      object({{"dt", leaf(std::move(length), {"Length of a tick", "每步时长"}, 1)},
              {"steps", leaf(tick(1, true),
                             {"Last tick; none: until stopped or the trace's end", "最后一步；无：直至停止或记录结束"},
                             nullptr)}}),
      {"Time", "时间"});
}

Json node() {
  const Json signals = leaf(
      schema::map("^[A-Za-z0-9_]{1,16}$", typed<observer::SignalMake>("signal", {"Given signal", "给定信号"}), 0, 64),
      {"Known input, disturbance and fault of a subsystem, by channel: u1, d1, f1",
       "子系统的已知输入、扰动与故障，按通道：u1、d1、f1"});
  return object({{"sensor", typed<SensorMake>("sensor", {"Sensor", "传感器"})}, {"signals", signals}},
                Json::array({"sensor"}));
}

Json network() {
  const Json named = choice({"none", "ring", "ladder", "path", "complete", "centre", "knn2", "knn3", "edges"});
  const Json by_number = {{"type", "string"}, {"pattern", "^(knn[1-9][0-9]*|radius[0-9.]+(e[+-]?[0-9]+)?)$"}};
  Json graph = leaf({{"anyOf", Json::array({named, by_number})}},
                    {"Graph by name; also knn<k> and radius<r>", "网络拓扑名称；也可用 knn<k> 与 radius<r>"}, "none");
  graph["x-live"] = true;
  const Json end = {{"type", {"string", "integer"}}};
  const Json pair = {{"type", "array"}, {"items", end}, {"minItems", 2}, {"maxItems", 2}};
  const Json edges =
      leaf({{"type", "array"}, {"items", pair}, {"maxItems", 4096}},
           {"Pairs of node ids, used where the graph is \"edges\"", "节点对，graph 为 \"edges\" 时使用"});
  return leaf(object({{"graph", std::move(graph)}, {"edges", edges}}), {"Network", "网络"});
}

Json covariance(const Words& words, const char* symbol) {
  const Json number = {{"type", "number"}, {"minimum", 0}};
  const Json diagonal = {{"type", "array"}, {"items", number}, {"minItems", 1}};
  const Json rows = {
      {"type", "array"}, {"minItems", 1}, {"items", {{"type", "array"}, {"items", {{"type", "number"}}}}}};
  Json result = leaf({{"anyOf", Json::array({number, diagonal, rows})}}, words, 0);
  result["x-symbol"] = symbol;
  result["x-type"] = "matrix";
  return result;
}

Json noise() {
  return leaf(object({{"Q", covariance({"Covariance of the process noise", "过程噪声协方差"}, "Q")},
                      {"P0", covariance({"Covariance of the initial estimates", "初始估计协方差"}, "P_0")},
                      {"Mw", covariance({"Ellipsoid of the bounded process noise", "有界过程噪声的椭球"}, "M_w")},
                      {"law", leaf(choice(law_names()), {"Law of the random noises", "随机噪声的分布"}, "gauss")},
                      {"bounded", leaf(choice(bounded_law_names()),
                                       {"How bounded noises are drawn", "有界噪声的取样方式"}, "uniform")}}),
              {"Noise", "噪声"});
}

Json initial(const Json& document) {
  const Json state = {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 1}, {"maxItems", 64}};
  Json nodes = Json::object();
  for (const auto& [id, member] : document["nodes"].items()) nodes[id] = state;
  const Json none = {{"type", "null"}};
  const Json truth = {{"anyOf", Json::array({state, none})}};
  const Json estimates = {{"anyOf", Json::array({object(std::move(nodes)), choice({"truth", "stationary"}), none})}};
  return leaf(
      object({{"truth", leaf(truth, {"True initial state; none: drawn", "真实初始状态；无：随机抽取"}, nullptr)},
              {"estimates", leaf(estimates,
                                 {"Initial estimates by node, \"truth\", or \"stationary\": errors as after running "
                                  "for ever; none: drawn",
                                  "各节点初始估计，或 \"truth\"，或 \"stationary\"（误差取平稳分布）；无：随机抽取"},
                                 nullptr)},
              {"x0_random",
               leaf(boolean(), {"The truth is drawn about its initial state", "真实初始状态在给定值附近随机抽取"},
                    false)}}),
      {"Initial values", "初始值"});
}

Json attack() {
  const Json place = {{"type", "string"},
                      {"pattern",
                       "^(link:(\\*|[A-Za-z0-9_]{1,16}-[A-Za-z0-9_]{1,16})|(sensor|actuator):[A-Za-z0-9_]{1,16}(\\.[A-"
                       "Za-z0-9_]{1,32})?)$"}};
  const Json places = {{"type", "array"}, {"items", place}, {"minItems", 1}, {"maxItems", 4096}};
  Json enabled = leaf(boolean(), {"Acts", "启用"}, true);
  enabled["x-live"] = true;
  Json result = object(
      {{"type", kinds<AttackMake>({"Attack", "攻击"})},
       {"on",
        leaf(places, {"Where: link:<from>-<to>, link:*, sensor:<node>[.<channel>] or actuator:<node>[.<channel>]",
                      "作用位置：link:<from>-<to>、link:*、sensor:<node>[.<channel>] 或 actuator:<node>[.<channel>]"})},
       {"from", leaf(tick(0, false), {"First tick", "起始步"}, 1)},
       {"to", leaf(tick(0, true), {"Last tick; none: to the end", "结束步；无：直至结束"}, nullptr)},
       {"schedule",
        leaf(object(
                 {{"every", leaf(tick(1, true), {"Period, ticks", "周期（步）"}, nullptr)},
                  {"for", leaf(tick(1, true), {"Ticks of every period in which it acts", "每周期内作用步数"}, nullptr)},
                  {"budget", leaf(tick(1, true), {"Ticks in which it acts altogether", "作用总步数上限"}, nullptr)}}),
             {"Bursts and budget; none: all the time", "间歇与预算；无：持续作用"})},
       {"enabled", std::move(enabled)},
       {"params", params_slot()}},
      Json::array({"type", "on"}));
  result["allOf"] = branches<AttackMake>("attack", "type");
  return result;
}

/// "none", or one of a registry with its params.
template <class Make>
Json optional(const std::string& kind, const Words& type, const Words& words) {
  std::vector<std::string> ids = Registry<Make>::ids();
  ids.insert(ids.begin(), "none");
  Json result = object({{"type", leaf(choice(ids), type, "none")}, {"params", params_slot()}});
  for (const auto& entry : Registry<Make>::all())
    result["properties"]["type"]["x-labels"][entry.id] = {{"en", entry.title.en}, {"zh", entry.title.zh}};
  result["allOf"] = branches<Make>(kind, "type");
  return leaf(std::move(result), words);
}

Json lane() {
  Json result = object(
      {{"method", kinds<MethodMake>({"Method", "方法"})},
       {"path", leaf(choice({"loop", "monitor"}), {"Who listens to the sensor channel", "谁接收传感器信道"}, "loop")},
       {"adversary", leaf(boolean(), {"Meets the adversary", "受攻击者影响"}, true)},
       {"enabled", leaf(boolean(), {"Runs", "启用"}, true)},
       {"params", params_slot()},
       {"protection", optional<ProtectionMake>("protection", {"Protection", "隐私保护"},
                                               {"What hides the lane's messages", "报文的隐私保护机制"})},
       {"detector", optional<DetectorMake>("detector", {"Detector", "检测器"},
                                           {"What judges the lane's innovation", "对新息进行判决的检测器"})}},
      Json::array({"method"}));
  result["allOf"] = branches<MethodMake>("method", "method");
  return result;
}

Json first_tick(const Words& words, int fallback) {
  return leaf(object({{"from", leaf(tick(0, false), words, fallback)}}), words);
}

Json metrics() {
  const Json window =
      object({{"from", leaf(tick(0, false), {"First tick scored", "评分起始步"}, 0)},
              {"to", leaf(tick(0, true), {"Last tick scored; none: the last", "评分结束步；无：最后一步"}, nullptr)}});
  const Json component = leaf(text(), {"State component", "状态分量"});
  Json figure =
      object({{"component", component}, {"from", window["properties"]["from"]}, {"to", window["properties"]["to"]}},
             Json::array({"component"}));
  const Json mse = leaf(schema::map("^mse_[a-z0-9_]{1,28}$", std::move(figure), 0, 32),
                        {"Mean square errors of single components, by name", "单个分量的均方误差，按名称"});
  return leaf(
      object({{"window", leaf(window, {"Ticks that are scored", "评分区间"})},
              {"mse", mse},
              {"detection", first_tick({"First tick that may count as a false alarm", "可计为误报的起始步"}, 50)},
              {"state",
               first_tick({"First tick of rmse_state and peak_error", "rmse_state 与 peak_error 的起始步"}, 20)}}),
      {"Metrics", "指标"});
}

Json log() {
  const Json signals = {
      {"type", "array"}, {"items", {{"type", "string"}, {"minLength", 1}}}, {"minItems", 1}, {"maxItems", 4096}};
  const Json keep = {{"type", {"number", "null"}}, {"exclusiveMinimum", 0}, {"maximum", 1e12}, {"x-unit", "s"}};
  const Json policy = {{"type", {"string", "null"}}, {"enum", {"lossless", "live", nullptr}}};
  return leaf(
      object({{"signals", leaf(signals, {"Signals that are logged, * for any text", "记录的信号，* 为任意文字"},
                               Json::array({"*"}))},
              {"every", leaf(tick(1, false), {"Every how many ticks", "记录间隔（步）"}, 1)},
              {"keep", leaf(keep, {"How long samples are kept; none: always", "样本保留时长；无：始终保留"}, nullptr)},
              {"policy", leaf(policy,
                              {"Lossless waits for the disk, live never does; none: by the pace",
                               "lossless 等待磁盘，live 从不等待；无：按运行速度"},
                              nullptr)}}),
      {"Log", "日志"});
}

Json properties(const Json& document) {
  const Json id = {{"type", "string"}, {"pattern", "^[a-z0-9][a-z0-9-]{0,63}$"}};
  return {{"vigil", leaf({{"const", 1}}, {"Version of the format", "格式版本"})},
          {"id", leaf(id, {"Id", "标识"})},
          {"title", title()},
          {"source", leaf(text(), {"Where it comes from", "来源"}, "")},
          {"family",
           leaf(choice({"consensus", "sparse", "replay", "observer", "privacy"}), {"Family", "类别"}, "consensus")},
          {"profile", leaf(text(), {"Profile", "参数组"}, "")},
          {"time", time()},
          {"plant", typed<PlantMake>("plant", {"Plant", "被控对象"})},
          {"controller", optional<ControllerMake>("controller", {"Controller", "控制器"}, {"Controller", "控制器"})},
          {"nodes", leaf(schema::map("^[A-Za-z0-9_]{1,16}$", node(), 1, section::kMostNodes), {"Nodes", "节点"})},
          {"network", network()},
          {"noise", noise()},
          {"initial", initial(document)},
          {"adversary",
           leaf(schema::map("^[a-z0-9_]{1,32}$", attack(), 0, section::kMostAttacks), {"Adversary", "攻击者"})},
          {"lanes", leaf(schema::map("^[a-z0-9_]{1,32}$", lane(), 1, section::kMostLanes), {"Lanes", "通道"})},
          {"metrics", metrics()},
          {"log", log()},
          {"reproducible", leaf(boolean(), {"Secrets, too, come from the seed", "机密也由种子生成"}, true)},
          {"view", leaf({{"type", "object"}}, {"Hints for the page", "页面提示"})}};
}

}  // namespace

Json Scenario::schema() const {
  Json result = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}};
  Json root = object(properties(document_), Json::array({"vigil", "id", "plant", "nodes", "lanes"}));
  result.update(leaf(std::move(root), {"Vigil scenario", "Vigil 场景"}));
  Json definitions = Json::object();
  define<PlantMake>("plant", definitions);
  define<SensorMake>("sensor", definitions);
  define<ControllerMake>("controller", definitions);
  define<AttackMake>("attack", definitions);
  define<MethodMake>("method", definitions);
  define<ProtectionMake>("protection", definitions);
  define<DetectorMake>("detector", definitions);
  define<observer::SignalMake>("signal", definitions);
  result["$defs"] = std::move(definitions);
  return result;
}

}  // namespace vigil
