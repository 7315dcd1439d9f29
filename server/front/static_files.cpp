#include "server/front/static_files.hpp"

#include <array>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "server/front/gzip.hpp"

namespace vigil {
namespace {

namespace fs = std::filesystem;

std::string type_of(std::string_view extension) {
  static const std::map<std::string_view, std::string_view> types = {{".html", "text/html; charset=utf-8"},
                                                                     {".js", "text/javascript; charset=utf-8"},
                                                                     {".mjs", "text/javascript; charset=utf-8"},
                                                                     {".css", "text/css; charset=utf-8"},
                                                                     {".json", "application/json"},
                                                                     {".map", "application/json"},
                                                                     {".svg", "image/svg+xml"},
                                                                     {".png", "image/png"},
                                                                     {".jpg", "image/jpeg"},
                                                                     {".ico", "image/x-icon"},
                                                                     {".webp", "image/webp"},
                                                                     {".woff2", "font/woff2"},
                                                                     {".woff", "font/woff"},
                                                                     {".txt", "text/plain; charset=utf-8"},
                                                                     {".webmanifest", "application/manifest+json"},
                                                                     {".wasm", "application/wasm"},
                                                                     {".csv", "text/csv; charset=utf-8"},
                                                                     {".md", "text/markdown; charset=utf-8"}};
  const auto found = types.find(extension);
  return std::string(found == types.end() ? "application/octet-stream" : found->second);
}

std::string etag_of(std::string_view body) {
  std::uint64_t hash = 14695981039346656037ull;  // FNV-1a
  for (const char c : body) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  static constexpr char kHex[] = "0123456789abcdef";
  std::string tag = "\"";
  for (int shift = 60; shift >= 0; shift -= 4) tag += kHex[(hash >> shift) & 15];
  return tag + "-" + std::to_string(body.size()) + "\"";
}

/// Bundlers put a hash of the content into the names below assets/: such a name never means anything else.
bool is_hash_named(const fs::path& relative) {
  const std::string stem = relative.stem().string();
  const auto dash = stem.find_last_of("-.");
  return relative.begin()->string() == "assets" && dash != std::string::npos && stem.size() - dash > 6;
}

std::string read_all(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

bool is_hidden(const fs::path& relative) {
  for (const auto& part : relative) {
    if (part.string().starts_with('.')) return true;
  }
  return false;
}

}  // namespace

StaticFiles::StaticFiles(const fs::path& folder, std::size_t max_bytes) {
  std::error_code error;
  fs::recursive_directory_iterator walk(folder, error);  // does not follow links to folders
  if (error) throw std::runtime_error("cannot read the page's folder " + folder.string() + ": " + error.message());
  std::size_t total = 0;
  for (const auto& entry : walk) {
    const fs::path relative = entry.path().lexically_relative(folder);
    if (entry.is_symlink() || !entry.is_regular_file() || is_hidden(relative)) continue;
    File file;
    file.body = read_all(entry.path());
    total += file.body.size();
    if (total > max_bytes) throw std::runtime_error("the page's folder " + folder.string() + " holds too much");
    file.type = type_of(entry.path().extension().string());
    file.etag = etag_of(file.body);
    file.immutable = is_hash_named(relative);
    const bool packed = file.type.starts_with("image/") && file.type != "image/svg+xml";
    if (!packed && !file.type.starts_with("font/")) file.gzip = gzip(file.body, 9);
    files_["/" + relative.generic_string()] = std::move(file);
  }
}

const StaticFiles::File* StaticFiles::find(std::string_view path) const {
  const auto found = files_.find(path);
  if (found != files_.end()) return &found->second;
  if (path == "/api" || path.starts_with("/api/")) return nullptr;
  const auto last = path.rfind('/');
  if (last == std::string_view::npos || path.find('.', last) != std::string_view::npos) return nullptr;
  const auto index = files_.find("/index.html");
  return index == files_.end() ? nullptr : &index->second;
}

bool StaticFiles::has(std::string_view path) const { return find(path) != nullptr; }

void StaticFiles::serve(const HttpRequest& request, HttpResponse& response) const {
  const File* file = find(request.path);
  if (!file) throw HttpError(404, "There is no page at this address.");
  response.set_header("ETag", file->etag);
  response.set_header("Vary", "Accept-Encoding");
  response.set_header("Cache-Control", file->immutable ? "public, max-age=31536000, immutable" : "no-cache");
  if (request.header("if-none-match").find(file->etag) != std::string::npos) {
    response.empty(304);
    return;
  }
  const bool packed = !file->gzip.empty() && accepts_gzip(request.header("accept-encoding"));
  if (packed) response.set_header("Content-Encoding", "gzip");
  response.text(packed ? file->gzip : file->body, file->type);
}

}  // namespace vigil
