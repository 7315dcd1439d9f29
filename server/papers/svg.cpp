#include "server/papers/svg.hpp"

#include <algorithm>
#include <cstdio>

#include "server/papers/scale.hpp"

namespace vigil::papers {
namespace {

constexpr double kWidth = 460, kHeight = 270, kLeft = 58, kRight = 12, kTop = 24, kBottom = 42;
constexpr std::size_t kHues = 9, kMostNames = 9;

std::string px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string text_at(double x, double y, const char* anchor, const std::string& words, const std::string& more = "") {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" + escaped(words) +
         "</text>";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& name) {
  return "<line class=\"" + name + "\" x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" +
         px(y2) + "\"/>";
}

std::string axes(const Panel& panel, const Scale& x, const Scale& y) {
  std::string svg;
  const double right = kWidth - kRight, bottom = kHeight - kBottom;
  for (const double tick : x.ticks()) {
    svg += line(x.at(tick), kTop, x.at(tick), bottom, "grid");
    svg += text_at(x.at(tick), bottom + 14, "middle", tick_text(tick));
  }
  for (const double tick : y.ticks()) {
    svg += line(kLeft, y.at(tick), right, y.at(tick), "grid");
    svg += text_at(kLeft - 5, y.at(tick) + 3.5, "end", tick_text(tick));
  }
  svg += text_at((kLeft + right) / 2, kHeight - 10, "middle", panel.x.label);
  const double middle = (kTop + bottom) / 2;
  svg += text_at(13, middle, "middle", panel.y.label, " transform=\"rotate(-90 13 " + px(middle) + ")\"");
  return svg + text_at(kLeft, 14, "start", panel.title, " class=\"title\"");
}

/// The path of a line or of steps, broken at what cannot be shown.
std::string path_of(const Series& series, const Scale& x, const Scale& y) {
  std::string path;
  bool open = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!x.shows(series.x[i]) || !y.shows(series.y[i])) {
      open = false;
      continue;
    }
    const std::string at_x = px(x.at(series.x[i])), at_y = px(y.at(series.y[i]));
    if (open && series.style == "steps") path += "H" + at_x + "V" + at_y;
    if (!open || series.style != "steps") path += (open ? "L" : "M") + at_x + " " + at_y;
    open = true;
  }
  return path;
}

std::string drawn(const Series& series, const Scale& x, const Scale& y, const std::string& colour) {
  if (series.style != "points" && series.style != "stems")
    return "<path class=\"" + colour + (series.style == "dashed" ? " dashed" : "") + "\" d=\"" + path_of(series, x, y) +
           "\"/>";
  std::string svg;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!x.shows(series.x[i]) || !y.shows(series.y[i])) continue;
    const double at_x = x.at(series.x[i]), at_y = y.at(series.y[i]);
    if (series.style == "stems") svg += line(at_x, y.at(0), at_x, at_y, colour);
    svg += "<circle class=\"" + colour + "\" cx=\"" + px(at_x) + "\" cy=\"" + px(at_y) + "\" r=\"2.5\"/>";
  }
  return svg;
}

std::string legend(const std::vector<std::pair<std::string, std::string>>& names) {
  if (names.size() < 2 || names.size() > kMostNames) return {};
  std::string html = "<p class=\"legend\">";
  for (const auto& [colour, name] : names) html += "<span><i class=\"" + colour + "\"></i>" + escaped(name) + "</span>";
  return html + "</p>";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string svg_of(const Panel& panel) {
  std::vector<const std::vector<double>*> xs, ys;
  bool stems = false;
  for (const Series& series : panel.series) {
    xs.push_back(&series.x);
    ys.push_back(&series.y);
    stems = stems || series.style == "stems";
  }
  const Scale x(xs, panel.x.log, kLeft, kWidth - kRight), y(ys, panel.y.log, kHeight - kBottom, kTop, stems);
  std::string body;
  std::vector<std::pair<std::string, std::string>> names;
  std::size_t next = 0;
  for (const Series& series : panel.series) {
    const bool edge = series.style == "edge";
    const std::string colour = edge ? "edge" : "c" + std::to_string(next++ % kHues);
    body += drawn(series, x, y, colour);
    if (!edge) names.emplace_back(colour, series.name);
  }
  return "<figure><svg viewBox=\"0 0 " + px(kWidth) + " " + px(kHeight) + "\" role=\"img\" aria-label=\"" +
         escaped(panel.title) + "\">" + axes(panel, x, y) + body + "</svg>" + legend(names) + "</figure>";
}

}  // namespace vigil::papers
