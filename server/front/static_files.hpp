/// The page's files, read into memory once at start: nothing a request says can reach the disk.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "server/front/message.hpp"

namespace vigil {

class StaticFiles {
 public:
  StaticFiles() = default;
  /// Reads every regular file below `folder`; links and hidden files are left out. Throws std::runtime_error if the
  /// folder cannot be read, or holds more than `max_bytes`.
  explicit StaticFiles(const std::filesystem::path& folder, std::size_t max_bytes = 256u << 20);
  bool empty() const { return files_.empty(); }
  /// True when `path` names a file, or is a page of the single-page application (no dot in its last segment and not
  /// below /api): those answer index.html.
  bool has(std::string_view path) const;
  /// Fills the answer: type, ETag, cache rule, gzip where the client takes it, 304 where it has it already.
  void serve(const HttpRequest& request, HttpResponse& response) const;

 private:
  struct File {
    std::string type;
    std::string etag;
    std::string body;
    std::string gzip;  ///< empty where it would not be smaller
    bool immutable = false;
  };
  const File* find(std::string_view path) const;
  std::map<std::string, File, std::less<>> files_;  ///< by path with a leading slash
};

}  // namespace vigil
