// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "files/scratch_folder.hpp"
#include "gateway/program_runs.hpp"
#include "gateway/view_content.hpp"
#include "gateway/web_server.hpp"
#include "view/what_if.hpp"

namespace clew::tools {

/// Branches, runs and insides that a page asks for. Each is a command of clew, told to the page as
/// a line to type. Branches and runs leave recordings that are served like the others, until this
/// ends.
class PageRuns {
 public:
  /// `content` serves `recordings`, in this order, already. `plugins` are loaded, and named to
  /// each command.
  static core::Result<std::unique_ptr<PageRuns>> create(bridge::ViewContent& content,
                                                        std::vector<std::string> recordings,
                                                        std::vector<std::string> plugins);

  /// Takes the page's requests from now on.
  void serve_with(bridge::WebServer& server);

 private:
  using Answer = bridge::WebContent::Answer;

  PageRuns(bridge::ViewContent& content, std::vector<std::string> recordings,
           std::vector<std::string> plugins, files::ScratchFolder folder);

  void branch(const std::string& body, Answer answer);
  void run(const std::string& body, Answer answer);
  void explain(const std::string& body, Answer answer);
  void record(std::vector<std::string> words, const std::string& what, Answer answer);
  void start(std::vector<std::string> words, const Answer& answer, bridge::ProgramRuns::Done done);
  void name_plugins(std::vector<std::string>& words) const;
  void finish(const bridge::ProgramEnd& end, const std::string& line, const std::string& file,
              const std::string& what, const Answer& answer);

  bridge::ViewContent& content_;
  std::vector<std::string> paths_;  ///< of what is served, in the order of their numbers
  std::vector<std::string> plugins_;
  files::ScratchFolder folder_;  ///< of our own recordings and worlds
  view::KnownNames names_;
  bridge::ProgramRuns programs_;
  bridge::WebServer* server_ = nullptr;
  bool polls_ = false;
  int count_ = 0;       ///< of our own recordings
  int rule_bases_ = 0;  ///< that were written
};

}  // namespace clew::tools
