// SPDX-License-Identifier: Apache-2.0
#include "security/run_security.hpp"

#include <fmt/format.h>

#include <ctime>

#include "core/check.hpp"
#include "security/credentials.hpp"
#include "security/key_directory.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;

/// Of keys that are forgotten with the run: longer than any run, and from the day before on, so
/// that a clock that is set back in the meantime ends nothing.
constexpr std::time_t kDay_s = 24 * 3600;
constexpr std::time_t kRunKeys_s = 366 * kDay_s;

Error tell(const std::string& directory, const std::vector<CredentialFault>& faults) {
  std::string text = faults.front().text;
  if (faults.size() > 1) text += fmt::format(" (and {} more)", faults.size() - 1);
  return {text + "; see 'clew keys check " + directory + "'", faults.front().file};
}

}  // namespace

Result<RunSecurity::Shared> RunSecurity::mint(const std::vector<SecuredParticipant>& participants) {
  const std::time_t now = std::time(nullptr);
  const Validity validity{now - kDay_s, now + kRunKeys_s};
  const CertifiedKey authority = make_authority("clew-run", validity);
  const auto governance = sign_text(governance_text(), authority);
  if (!governance.ok()) return governance.error();
  auto security = std::make_shared<RunSecurity>();
  for (const SecuredParticipant& one : participants) {
    for (const Vendor vendor : one.vendors) {
      const auto credentials =
          mint_identity(authority, *governance, one.name, {half_for(vendor), one.rights}, validity);
      if (!credentials.ok()) return credentials.error();
      CLEW_RETURN_IF_ERROR(security->add(one.name, vendor, *credentials));
    }
  }
  return Shared(std::move(security));
}

Result<RunSecurity::Shared> RunSecurity::read(const std::string& directory,
                                              const std::vector<SecuredParticipant>& participants) {
  const std::time_t now = std::time(nullptr);
  const KeyDirectory keys(directory);
  std::vector<CredentialFault> faults;
  const KeyDirectory::Shared shared = keys.read_shared(now, faults);
  if (!faults.empty()) return tell(directory, faults);
  auto security = std::make_shared<RunSecurity>();
  for (const SecuredParticipant& one : participants) {
    for (const Vendor vendor : one.vendors) {
      const SecurityTexts credentials =
          keys.read_identity(shared, one.name, vendor, one.rights, now, faults);
      CLEW_RETURN_IF_ERROR(security->add(one.name, vendor, credentials));
    }
  }
  if (!faults.empty()) return tell(directory, faults);
  return Shared(std::move(security));
}

const SecurityFiles& RunSecurity::files(const std::string& name, Vendor vendor) const {
  const auto found = files_.find({name, vendor});
  CLEW_CHECK(found != files_.end(), name);
  return found->second;
}

Result<void> RunSecurity::add(const std::string& name, Vendor vendor,
                              const SecurityTexts& credentials) {
  SecurityFiles files;
  const std::pair<std::string*, const std::string*> all[] = {
      {&files.authority, &credentials.authority},
      {&files.certificate, &credentials.certificate},
      {&files.private_key, &credentials.private_key},
      {&files.governance, &credentials.governance},
      {&files.permissions, &credentials.permissions}};
  for (const auto& [path, content] : all) {
    auto kept = keep(*content);
    if (!kept.ok()) return kept.error();
    *path = std::move(kept).value();
  }
  files_[{name, vendor}] = std::move(files);
  return {};
}

Result<std::string> RunSecurity::keep(const std::string& content) {
  std::unique_ptr<MemoryFile>& file = kept_[content];
  if (file == nullptr) file = std::make_unique<MemoryFile>("clew-security", content);
  if (!file->failure().empty()) return Error{file->failure(), {}};
  return file->path();
}

}  // namespace clew::bridge
