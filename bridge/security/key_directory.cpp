// SPDX-License-Identifier: Apache-2.0
#include "security/key_directory.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "security/kept_file.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;
using Faults = std::vector<CredentialFault>;

std::string folder_of(const std::string& name, Vendor vendor) {
  return name + '.' + std::string(vendor_name(vendor));
}

Result<void> make_private_directory(const std::string& path) {
  if (::mkdir(path.c_str(), S_IRWXU) == 0 || errno == EEXIST) return {};
  return Error{std::string("cannot be made: ") + std::strerror(errno), path};
}

/// The same faults, with the paths of their files.
void append_in(const std::string& folder, Faults more, Faults& faults) {
  for (CredentialFault& fault : more) {
    faults.push_back({folder + '/' + fault.file, std::move(fault.text)});
  }
}

}  // namespace

SubjectHalf half_for(Vendor vendor) {
  return vendor == Vendor::kCycloneDds ? SubjectHalf::kLower : SubjectHalf::kUpper;
}

Result<void> KeyDirectory::create(const std::string& authority, const Validity& validity) const {
  CLEW_RETURN_IF_ERROR(make_private_directory(path_));
  for (const char* file : {kAuthorityFile, kAuthorityKeyFile, kGovernanceFile}) {
    std::error_code code;
    if (std::filesystem::exists(path_to(file), code)) {
      return Error{"is there already; an authority is never replaced", path_to(file)};
    }
  }
  const CertifiedKey keys = make_authority(authority, validity);
  const auto governance = sign_text(governance_text(), keys);
  if (!governance.ok()) return governance.error();
  CLEW_RETURN_IF_ERROR(
      write_kept_file(path_to(kAuthorityKeyFile), keys.private_key, Secrecy::kSecret));
  CLEW_RETURN_IF_ERROR(
      write_kept_file(path_to(kAuthorityFile), keys.certificate, Secrecy::kPublic));
  return write_kept_file(path_to(kGovernanceFile), *governance, Secrecy::kPublic);
}

Result<void> KeyDirectory::mint(const std::string& name, Vendor vendor, const Rights& rights,
                                const Validity& validity) const {
  Faults faults;
  const Shared shared = read_shared(validity.not_before, faults);
  if (!faults.empty()) return Error{faults.front().text, faults.front().file};
  if (shared.authority.private_key.empty()) {
    return Error{"is not there; without it nothing can be signed", path_to(kAuthorityKeyFile)};
  }
  const auto minted = mint_identity(shared.authority, shared.governance, name,
                                    {half_for(vendor), rights}, validity);
  if (!minted.ok()) return Error{minted.error().message, path_to(kAuthorityKeyFile)};
  const std::string folder = path_to(folder_of(name, vendor));
  CLEW_RETURN_IF_ERROR(make_private_directory(folder));
  CLEW_RETURN_IF_ERROR(
      write_kept_file(folder + '/' + kPrivateKeyFile, minted->private_key, Secrecy::kSecret));
  CLEW_RETURN_IF_ERROR(
      write_kept_file(folder + '/' + kCertificateFile, minted->certificate, Secrecy::kPublic));
  return write_kept_file(folder + '/' + kPermissionsFile, minted->permissions, Secrecy::kPublic);
}

KeyDirectory::Shared KeyDirectory::read_shared(std::time_t now, Faults& faults) const {
  Shared shared;
  check_kept_directory(path_, faults);
  std::error_code code;
  if (!std::filesystem::is_directory(path_, code)) return shared;
  shared.authority.certificate = read_kept_file(path_to(kAuthorityFile), Secrecy::kPublic, faults);
  shared.governance = read_kept_file(path_to(kGovernanceFile), Secrecy::kPublic, faults);
  const std::string key = path_to(kAuthorityKeyFile);
  if (std::filesystem::exists(key, code)) {
    shared.authority.private_key = read_kept_file(key, Secrecy::kSecret, faults);
  }
  append_in(path_, check_authority(shared.authority, shared.governance, now), faults);
  return shared;
}

SecurityTexts KeyDirectory::read_identity(const Shared& shared, const std::string& name,
                                          Vendor vendor, const Rights& rights, std::time_t now,
                                          Faults& faults) const {
  SecurityTexts credentials;
  credentials.authority = shared.authority.certificate;
  credentials.governance = shared.governance;
  const std::string folder = path_to(folder_of(name, vendor));
  check_kept_directory(folder, faults);
  std::error_code code;
  if (!std::filesystem::is_directory(folder, code)) return credentials;
  const auto read = [&](const char* file, Secrecy secrecy) {
    return read_kept_file(folder + '/' + file, secrecy, faults);
  };
  credentials.certificate = read(kCertificateFile, Secrecy::kPublic);
  credentials.private_key = read(kPrivateKeyFile, Secrecy::kSecret);
  credentials.permissions = read(kPermissionsFile, Secrecy::kPublic);
  append_in(folder, check_identity(credentials, {half_for(vendor), rights}, now), faults);
  return credentials;
}

std::vector<std::pair<std::string, Vendor>> KeyDirectory::identities() const {
  std::vector<std::pair<std::string, Vendor>> found;
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(path_, code)) {
    const std::string extension = entry.path().extension().string();
    if (extension.empty()) continue;
    const auto vendor = vendor_from_name(extension.substr(1));
    if (vendor) found.emplace_back(entry.path().stem().string(), *vendor);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace clew::bridge
