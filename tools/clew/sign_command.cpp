// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "files/whole_file.hpp"
#include "log/log.hpp"
#include "recording/run_recording.hpp"
#include "runtime/user_folders.hpp"
#include "security/kept_file.hpp"
#include "security/signature.hpp"

namespace clew::tools {
namespace {

using bridge::CertifiedKey;
using bridge::Secrecy;
using core::Error;
using core::Result;

constexpr std::time_t kDay_s = 24 * 3600;
constexpr std::time_t kOwnKey_s = 3650 * kDay_s;

struct SignOptions {
  std::string recording;
  std::string keys;  ///< a directory, whose authority signs
  std::string key;   ///< a file with a key and its certificate
  bool force = false;
};

/// `anna@lab3`.
std::string own_name() {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  const passwd* const user = ::getpwuid(::geteuid());
  const std::string name = user != nullptr ? user->pw_name : std::to_string(::geteuid());
  // A name in a certificate has 64 letters at most.
  return (name + '@' + host.data()).substr(0, 64);
}

Result<std::string> own_key_file() {
  if (const auto own = runtime::user_config_folder()) return *own + "/signing.pem";
  return Error{"where is your key? set HOME or XDG_CONFIG_HOME, or give --key or --keys", {}};
}

Result<CertifiedKey> read_key(const std::vector<std::string>& files) {
  std::string text;
  std::vector<bridge::CredentialFault> faults;
  for (const std::string& file : files) {
    const bool is_public = &file != &files.front();
    text += bridge::read_kept_file(file, is_public ? Secrecy::kPublic : Secrecy::kSecret, faults);
  }
  if (!faults.empty()) return Error{faults.front().text, faults.front().file};
  auto key = bridge::read_certified_key(text);
  if (!key.ok()) return Error{key.error().message, files.front()};
  return key;
}

/// The user's own key, made when it is first needed.
Result<CertifiedKey> own_key() {
  const auto file = own_key_file();
  if (!file.ok()) return file.error();
  std::error_code code;
  if (std::filesystem::exists(*file, code)) return read_key({*file});
  const std::filesystem::path folder = std::filesystem::path(*file).parent_path();
  CLEW_RETURN_IF_ERROR(files::make_directory(folder.parent_path().string()));
  if (::mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST) {
    return Error{"cannot be made: " + std::generic_category().message(errno), folder.string()};
  }
  const std::time_t now = std::time(nullptr);
  CertifiedKey key = bridge::make_signing_key(own_name(), {now - kDay_s, now + kOwnKey_s});
  CLEW_RETURN_IF_ERROR(
      bridge::write_kept_file(*file, key.private_key + key.certificate, Secrecy::kSecret));
  logs::info("made a key to sign with: {}", *file);
  return key;
}

Result<CertifiedKey> key_of(const SignOptions& options) {
  if (!options.keys.empty()) {
    return read_key({options.keys + '/' + bridge::kAuthorityKeyFile,
                     options.keys + '/' + bridge::kAuthorityFile});
  }
  return options.key.empty() ? own_key() : read_key({options.key});
}

int sign_command(const SignOptions& options) {
  const auto recording = bridge::RunRecording::open(options.recording);
  if (!recording.ok()) return complain(recording.error());
  if (recording->description().split.any()) {
    return complain({"is split into files, and a signature is of one", options.recording, 0, 0});
  }
  const std::string path = bridge::signature_file(options.recording);
  std::error_code code;
  if (!options.force && std::filesystem::exists(path, code)) {
    return complain({"is there already; --force replaces it", path, 0, 0});
  }
  const auto key = key_of(options);
  if (!key.ok()) return complain(key.error());
  const auto written = bridge::sign_file(options.recording, *key);
  if (!written.ok()) return complain(written.error());
  const auto signature = bridge::read_signature(options.recording);
  if (!signature.ok()) return complain(signature.error(), kExitFailed);
  fmt::print("{}: signed by '{}', key {}\n", path, (*signature)->signer, (*signature)->key);
  return kExitGood;
}

}  // namespace

void add_sign(CLI::App& main, int& status) {
  const auto options = std::make_shared<SignOptions>();
  CLI::App* app = main.add_subcommand(
      "sign", "Sign a recording with your key; 'clew info' says who signed, and whether it holds");
  app->add_option("recording", options->recording)->required();
  CLI::Option* key = app->add_option(
      "--key", options->key, "a file with a private key and its certificate (your own, made once)");
  app->add_option("--keys", options->keys, "the authority of a directory of 'clew keys' signs")
      ->excludes(key);
  app->add_flag("--force", options->force, "replace a signature that is there");
  app->callback([options, &status] { status = sign_command(*options); });
}

}  // namespace clew::tools
