// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_reader.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/nearest_name.hpp"
#include "core/yaml_text.hpp"

namespace clew::core {
namespace {

constexpr std::size_t kMostShown = 40;
// Shorter lists are left to yaml-cpp.
constexpr std::size_t kLeastNumberList = 4096;

// What yaml-cpp takes and we do not. An exception, because it passes through yaml-cpp's parser.
class Refusal : public YAML::ParserException {
 public:
  using ParserException::ParserException;
};

// The whole text as a decimal number of type T, whatever the locale.
template <typename T>
bool parse_number(std::string_view text, T& number) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, number);
  return code == std::errc() && stop == end;
}

bool is_beyond_64_bits(std::string_view text) {
  std::int64_t number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, number);
  return code == std::errc::result_out_of_range && stop == end;
}

// The value of an option, `--set sense.range_m`, is one line that stands in no file: its place is
// the option.
bool is_option(const std::string& file) { return file.compare(0, 2, "--") == 0; }

}  // namespace

struct YamlNode::Value {
  YamlKind kind = YamlKind::kNull;
  bool quoted = false;
  int line = 0;
  int column = 0;
  // A scalar's text, or where a list's or map's children are listed; a map's are key, value, key
  // ...
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// All values of a file in a few arrays: a world of 100,000 walls has half a million.
struct YamlNode::Document {
  std::string file;
  std::string text;  // of all scalars
  std::vector<Value> values;
  std::vector<std::uint32_t> children;
  std::uint32_t root = 0;

  std::string_view scalar(const Value& value) const {
    return std::string_view(text).substr(value.first, value.count);
  }
};

/// Makes a document of yaml-cpp's events.
class YamlNode::Builder : public YAML::EventHandler {
 public:
  /// `lists` are those of `whole` that are emptied in `yaml`, the text of the events.
  Builder(Document& document, std::string_view yaml, std::string_view whole,
          const std::vector<NumberList>& lists)
      : document_(document), yaml_(yaml), whole_(whole), lists_(lists) {}

  /// The document of `whole`, of which these lists are read past yaml-cpp. Says whether it told of
  /// each of them.
  static Result<YamlNode> build(std::string_view whole, const std::vector<NumberList>& lists,
                                const std::string& file, bool& has_all_lists);

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (has_document_) refuse(mark, "a second document begins here; one a file is allowed");
    has_document_ = true;
  }
  void OnDocumentEnd() override { document_.root = pending_.empty() ? 0 : pending_.back(); }

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add(mark, "", anchor, YamlKind::kNull);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    refuse(mark, "an alias; write the value out");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    Value& value = add(mark, tag, anchor, YamlKind::kScalar);
    value.quoted = tag == "!";
    if (value.quoted && !has_closing_quote(yaml_, static_cast<std::size_t>(mark.pos))) {
      refuse(mark, "a text that begins with a quote and does not end with one");
    }
    value.first = static_cast<std::uint32_t>(document_.text.size());
    value.count = static_cast<std::uint32_t>(text.size());
    document_.text += text;
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    const Value& value = add(mark, tag, anchor, YamlKind::kList);
    open_.push_back(pending_.size());
    if (next_list_ == lists_.size() || lists_[next_list_].line != value.line ||
        lists_[next_list_].column != value.column) {
      return;
    }
    visit_number_list(whole_, lists_[next_list_++], *this);
    reopened_ = true;
  }
  void OnSequenceEnd() override {
    if (!std::exchange(reopened_, false)) end();
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    add(mark, tag, anchor, YamlKind::kMap);
    open_.push_back(pending_.size());
  }
  void OnMapEnd() override { check_keys(end()); }

  // Of a list of numbers.
  void open(int line, int column) {
    add(line, column, YamlKind::kList);
    open_.push_back(pending_.size());
  }
  void number(int line, int column, std::string_view text) {
    Value& value = add(line, column, YamlKind::kScalar);
    value.first = static_cast<std::uint32_t>(document_.text.size());
    value.count = static_cast<std::uint32_t>(text.size());
    document_.text += text;
  }
  void close() { end(); }

 private:
  [[noreturn]] static void refuse(const YAML::Mark& mark, const std::string& message) {
    throw Refusal(mark, message);
  }
  [[noreturn]] static void refuse(const Value& value, const std::string& message) {
    YAML::Mark mark;
    mark.line = value.line - 1;
    mark.column = value.column - 1;
    refuse(mark, message);
  }

  Value& add(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, YamlKind kind) {
    if (anchor != 0) refuse(mark, "an anchor; write the value out where it is needed");
    // yaml-cpp's own marks: "?" a plain scalar, list or map, "!" a quoted scalar.
    if (!tag.empty() && tag != "?" && tag != "!") refuse(mark, "a tag; none is allowed");
    return add(mark.line + 1, mark.column + 1, kind);
  }

  Value& add(int line, int column, YamlKind kind) {
    pending_.push_back(static_cast<std::uint32_t>(document_.values.size()));
    Value value;
    value.kind = kind;
    value.line = line;
    value.column = column;
    document_.values.push_back(value);
    return document_.values.back();
  }

  // Lists the children of the list or map that ends here.
  const Value& end() {
    const std::size_t first = open_.back();
    open_.pop_back();
    Value& value = document_.values[pending_[first - 1]];
    value.first = static_cast<std::uint32_t>(document_.children.size());
    value.count = static_cast<std::uint32_t>(pending_.size() - first);
    document_.children.insert(document_.children.end(),
                              pending_.begin() + static_cast<std::ptrdiff_t>(first),
                              pending_.end());
    pending_.resize(first);
    return value;
  }

  void check_keys(const Value& map) const {
    std::vector<const Value*> keys;
    for (std::uint32_t i = 0; i < map.count; i += 2) {
      const Value& key = document_.values[document_.children[map.first + i]];
      if (key.kind != YamlKind::kScalar) refuse(key, "a key that is no text");
      keys.push_back(&key);
    }
    // Values lie in the order of the file, so the first of two equal keys sorts first.
    std::sort(keys.begin(), keys.end(), [this](const Value* a, const Value* b) {
      const int order = document_.scalar(*a).compare(document_.scalar(*b));
      return order != 0 ? order < 0 : a < b;
    });
    for (std::size_t i = 1; i < keys.size(); ++i) {
      if (document_.scalar(*keys[i - 1]) != document_.scalar(*keys[i])) continue;
      refuse(*keys[i], "duplicate key '" + std::string(document_.scalar(*keys[i])) +
                           "', first given in line " + std::to_string(keys[i - 1]->line));
    }
  }

  Document& document_;
  std::string_view yaml_;
  std::string_view whole_;
  const std::vector<NumberList>& lists_;
  std::size_t next_list_ = 0;
  bool reopened_ = false;  // the list that the last event began was closed already
  bool has_document_ = false;
  std::vector<std::uint32_t> pending_;  // values whose list or map is still open
  std::vector<std::size_t> open_;       // where each open one's children begin in pending_
};

Result<YamlNode> YamlNode::Builder::build(std::string_view whole,
                                          const std::vector<NumberList>& lists,
                                          const std::string& file, bool& has_all_lists) {
  auto document = std::make_shared<Document>();
  document->file = file;
  const std::string yaml = without_number_lists(whole, lists);
  Builder builder(*document, yaml, whole, lists);
  has_all_lists = false;
  try {
    std::istringstream stream(yaml);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& e) {
    const bool is_refusal = dynamic_cast<const Refusal*>(&e) != nullptr;
    const std::string message = is_refusal ? e.msg : "broken YAML: " + e.msg;
    if (is_option(file)) return Error{message, file};
    // A null mark, -1, gives 0: no place.
    return Error{message, file, e.mark.line + 1, e.mark.column + 1};
  }
  has_all_lists = builder.next_list_ == lists.size();
  if (!builder.has_document_) return Error{"the file is empty", file};
  const std::uint32_t root = document->root;
  return YamlNode(std::move(document), root);
}

// Long lists of numbers, such as a world's walls, are read past yaml-cpp, which takes two
// microseconds a number.
Result<YamlNode> YamlNode::parse(std::string_view yaml, const std::string& file) {
  bool has_all_lists = false;
  const auto lists = find_number_lists(yaml, kLeastNumberList);
  if (!lists.empty()) {
    auto node = Builder::build(yaml, lists, file, has_all_lists);
    // A text that only looks like such a list, within quotes: all of it is for yaml-cpp.
    if (has_all_lists) return node;
  }
  return Builder::build(yaml, {}, file, has_all_lists);
}

YamlKind YamlNode::kind() const { return document_->values[index_].kind; }
const std::string& YamlNode::file() const { return document_->file; }
int YamlNode::line() const { return is_option(file()) ? 0 : document_->values[index_].line; }
int YamlNode::column() const { return is_option(file()) ? 0 : document_->values[index_].column; }

Error YamlNode::error(std::string message) const {
  return Error{std::move(message), file(), line(), column()};
}

Error YamlNode::expected(std::string_view what) const {
  return error("found " + found() + ", expected " + std::string(what));
}

std::string YamlNode::found() const {
  const Value& value = document_->values[index_];
  switch (value.kind) {
    case YamlKind::kNull:
      return "nothing";
    case YamlKind::kList:
      return "a list of " + std::to_string(value.count);
    case YamlKind::kMap:
      return "a map";
    case YamlKind::kScalar:
      break;
  }
  std::string text(document_->scalar(value).substr(0, kMostShown));
  if (value.count > kMostShown) text += "...";
  return value.quoted ? "the text \"" + text + "\"" : "'" + text + "'";
}

Result<double> YamlNode::number() const {
  const Value& value = document_->values[index_];
  double number = 0.0;
  if (value.kind != YamlKind::kScalar || value.quoted ||
      !parse_number(document_->scalar(value), number) || !std::isfinite(number)) {
    return expected("a finite number");
  }
  return number;
}

Result<std::int64_t> YamlNode::integer() const {
  const Value& value = document_->values[index_];
  std::int64_t number = 0;
  if (value.kind == YamlKind::kScalar && !value.quoted) {
    const std::string_view text = document_->scalar(value);
    if (parse_number(text, number)) return number;
    if (is_beyond_64_bits(text)) {
      return expected("a whole number from -9223372036854775808 to 9223372036854775807");
    }
  }
  return expected("a whole number");
}

Result<bool> YamlNode::boolean() const {
  const Value& value = document_->values[index_];
  const std::string_view text =
      value.kind == YamlKind::kScalar && !value.quoted ? document_->scalar(value) : "";
  if (text != "true" && text != "false") return expected("true or false");
  return text == "true";
}

Result<std::string> YamlNode::string() const {
  const Value& value = document_->values[index_];
  if (value.kind != YamlKind::kScalar) return expected("a text");
  return std::string(document_->scalar(value));
}

Result<std::vector<YamlNode>> YamlNode::items() const {
  const Value& value = document_->values[index_];
  if (value.kind != YamlKind::kList) return expected("a list");
  std::vector<YamlNode> items;
  items.reserve(value.count);
  for (std::uint32_t i = 0; i < value.count; ++i) {
    items.push_back(YamlNode(document_, document_->children[value.first + i]));
  }
  return items;
}

Result<std::vector<double>> YamlNode::numbers(std::size_t count, std::string_view allowed) const {
  const Value& value = document_->values[index_];
  if (value.kind != YamlKind::kList || value.count != count) return expected(allowed);
  std::vector<double> numbers(count);
  for (std::uint32_t i = 0; i < value.count; ++i) {
    const auto number = YamlNode(document_, document_->children[value.first + i]).number();
    if (!number.ok()) return number.error();
    numbers[i] = *number;
  }
  return numbers;
}

Result<std::vector<YamlNode::Entry>> YamlNode::entries() const {
  const Value& value = document_->values[index_];
  if (value.kind != YamlKind::kMap) return expected("a map");
  std::vector<Entry> entries;
  entries.reserve(value.count / 2);
  for (std::uint32_t i = 0; i < value.count; i += 2) {
    YamlNode key(document_, document_->children[value.first + i]);
    std::string name(document_->scalar(document_->values[key.index_]));
    entries.push_back({std::move(name), std::move(key),
                       YamlNode(document_, document_->children[value.first + i + 1])});
  }
  return entries;
}

Result<void> YamlNode::check_keys(const std::vector<std::string>& allowed) const {
  const auto all = entries();
  if (!all.ok()) return all.error();
  for (const Entry& entry : *all) {
    if (std::find(allowed.begin(), allowed.end(), entry.key) == allowed.end()) {
      return entry.key_node.error(unknown_name("key", entry.key, allowed));
    }
  }
  return {};
}

std::optional<YamlNode> YamlNode::find(std::string_view key) const {
  const Value& value = document_->values[index_];
  if (value.kind != YamlKind::kMap) return std::nullopt;
  for (std::uint32_t i = 0; i < value.count; i += 2) {
    const Value& candidate = document_->values[document_->children[value.first + i]];
    if (document_->scalar(candidate) == key) {
      return YamlNode(document_, document_->children[value.first + i + 1]);
    }
  }
  return std::nullopt;
}

Result<YamlNode> YamlNode::at(std::string_view key) const {
  if (kind() != YamlKind::kMap) return expected("a map");
  auto value = find(key);
  if (!value) return error("missing key '" + std::string(key) + "'");
  return *std::move(value);
}

}  // namespace clew::core
