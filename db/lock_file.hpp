/// One writer a log: an advisory lock beside the file, gone with the process however it ends.
#pragma once

#include <string>

namespace vigil {

class LockFile {
 public:
  /// Locks `path`.lock. Throws LogError (unusable) where another process or writer holds it, or the folder is not
  /// writable.
  explicit LockFile(const std::string& path);
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace vigil
