// SPDX-License-Identifier: Apache-2.0
#include "gateway/view_content.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "gateway/foxglove_client.hpp"
#include "gateway/json_text.hpp"
#include "gateway/page_client.hpp"

namespace clew::bridge {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kRecordings = "/recordings/";

WebResponse not_here() { return {404, "text/plain; charset=utf-8", "not here\n", {}}; }

std::optional<std::size_t> index_of(std::string_view text, std::size_t size) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || end != text.data() + text.size() || index >= size) return {};
  return index;
}

WebResponse json_response(const ordered_json& json) {
  return {200, "application/json", json_text(json), {}};
}

}  // namespace

std::string policy_of(std::string_view page) {
  constexpr std::string_view kBefore = "Content-Security-Policy\" content=\"";
  const std::size_t found = page.find(kBefore);
  if (found == std::string_view::npos) return {};
  page.remove_prefix(found + kBefore.size());
  return std::string(page.substr(0, page.find('"')));
}

ViewContent::ViewContent(std::string_view page, std::vector<ServedRecording> recordings)
    : page_(page), policy_(policy_of(page)), recordings_(std::move(recordings)) {}

void ViewContent::answer(const WebRequest& request, Answer answer) {
  const std::string_view path = request.path;
  if (request.posts) {
    const auto handler = handlers_.find(request.path);
    if (handler == handlers_.end()) return answer(not_here());
    return handler->second(request.body, std::move(answer));
  }
  if (path == "/") return answer(page());
  if (path == "/session") return answer(session());
  if (path.substr(0, kRecordings.size()) == kRecordings) {
    return answer(recording(path.substr(kRecordings.size()), request.range));
  }
  const auto text = texts_.find(request.path);
  answer(text == texts_.end() ? not_here()
                              : WebResponse{200, "application/json", text->second, {}});
}

std::size_t ViewContent::add_recording(ServedRecording recording) {
  recordings_.push_back(std::move(recording));
  return recordings_.size() - 1;
}

std::string ViewContent::protocol_for(const SocketRequest& request) {
  if (live_ == nullptr) return {};
  const auto& offered = request.protocols;
  const auto speaks = [&](const char* protocol) {
    return std::find(offered.begin(), offered.end(), protocol) != offered.end();
  };
  if (request.path == "/live") {
    return is_live_ && request.from_own_page && speaks(kLiveProtocol) ? kLiveProtocol : "";
  }
  if (request.path != "/") return {};
  for (const char* protocol : kFoxgloveProtocols) {
    if (speaks(protocol)) return protocol;
  }
  return {};
}

std::unique_ptr<SocketClient> ViewContent::connect(const SocketRequest&,
                                                   const std::string& protocol,
                                                   SocketSender& sender) {
  if (fill_) std::exchange(fill_, nullptr)();
  if (protocol == kLiveProtocol) return std::make_unique<PageClient>(*live_, sender);
  return std::make_unique<FoxgloveClient>(*live_, sender);
}

// Framing is a rule that a page cannot give itself.
WebResponse ViewContent::page() const {
  return {200,
          "text/html; charset=utf-8",
          std::string(page_),
          {{"Content-Security-Policy", policy_ + "; frame-ancestors 'none'"},
           {"Cross-Origin-Opener-Policy", "same-origin"}}};
}

WebResponse ViewContent::session() const {
  ordered_json json;
  json["recordings"] = ordered_json::array();
  for (std::size_t i = 0; i < recordings_.size(); ++i) {
    json["recordings"].push_back(
        {{"id", i}, {"name", recordings_[i].name()}, {"files", recordings_[i].files().size()}});
  }
  json["live"] = is_live_;
  return json_response(json);
}

WebResponse ViewContent::recording(std::string_view place, const std::string& range) const {
  const std::size_t slash = place.find('/');
  const auto number = index_of(place.substr(0, slash), recordings_.size());
  if (!number) return not_here();
  const std::vector<ServedFile>& files = recordings_[*number].files();
  const bool is_first = slash == std::string_view::npos;
  const auto file =
      is_first ? std::optional(std::size_t{0}) : index_of(place.substr(slash + 1), files.size());
  return file ? files[*file].answer(range) : not_here();
}

}  // namespace clew::bridge
