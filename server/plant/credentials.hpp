/// How the server shows a broker who it is.
#pragma once

#include <string>

namespace vigil {

struct BrokerCredentials {
  std::string user, password;
  std::string ca;           ///< file: who may have signed the broker's certificate; empty: whom the system trusts
  std::string certificate;  ///< file: of this client
  std::string key;          ///< file
  std::string key_password;
  bool open_to_others = false;  ///< the file that they came from can be read by other users

  /// Of a JSON object {"user","password","ca","certificate","key","key_password"} or lines `name = value` of the same
  /// names; files are beside the file unless they begin with '/'. Throws std::runtime_error with one sentence that
  /// shows no secret.
  static BrokerCredentials from_file(const std::string& path);
};

}  // namespace vigil
