// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "dds/security_files.hpp"
#include "security/rights.hpp"
#include "vendors/memory_file.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::bridge {

struct SecurityTexts;

/// Who takes part in a secured run.
struct SecuredParticipant {
  std::string name;
  std::vector<Vendor> vendors;  ///< that may carry it: of a program of somebody else's, each
  Rights rights;
};

/// The identities of a run's participants, as files in memory that nobody can change: what was
/// checked is what is used. They are gone with the process, however it ends.
class RunSecurity {
 public:
  using Shared = std::shared_ptr<const RunSecurity>;

  /// An authority for this run alone, which vouches for `participants` and is forgotten.
  static core::Result<Shared> mint(const std::vector<SecuredParticipant>& participants);
  /// Those of a KeyDirectory. Refused: a directory in which anything that the run needs is missing
  /// or wrong; the error says the first fault, and how many there are.
  static core::Result<Shared> read(const std::string& directory,
                                   const std::vector<SecuredParticipant>& participants);

  /// Of a participant that is among those.
  const SecurityFiles& files(const std::string& name, Vendor vendor) const;

 private:
  core::Result<void> add(const std::string& name, Vendor vendor, const SecurityTexts& credentials);
  /// The path of a file with that content; one for equal contents.
  core::Result<std::string> keep(const std::string& content);

  std::map<std::string, std::unique_ptr<MemoryFile>> kept_;  ///< by content
  std::map<std::pair<std::string, Vendor>, SecurityFiles> files_;
};

}  // namespace clew::bridge
