#include "db/lock_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "db/records.hpp"

namespace vigil {

LockFile::LockFile(const std::string& path) {
  const std::string name = path + ".lock";
  descriptor_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) {
    throw LogError(LogError::Kind::unusable,
                   "The log " + path + " cannot be locked: " + std::strerror(errno) + " (" + name + ").");
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    char holder[32] = {};
    const auto size = ::pread(descriptor_, holder, sizeof holder - 1, 0);
    ::close(descriptor_);
    const std::string who = size > 0 ? " (process " + std::string(holder) + ")" : std::string();
    throw LogError(LogError::Kind::unusable,
                   "The log " + path + " is in use by another vigil" + who + "; stop it first or name another file.");
  }
  const std::string holder = std::to_string(::getpid());
  if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, holder.data(), holder.size(), 0) < 0) {
    // The lock holds all the same; only its owner's name is missing, as on a full disk.
    return;
  }
}

LockFile::~LockFile() { ::close(descriptor_); }

}  // namespace vigil
