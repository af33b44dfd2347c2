// SPDX-License-Identifier: Apache-2.0
#include "hunt/setting_tree.hpp"

#include <algorithm>

#include "core/quoted.hpp"
#include "core/yaml_reader.hpp"

namespace clew::hunt {
namespace {

using core::Result;
using core::YamlKind;
using core::YamlNode;
using Kind = SettingTree::Kind;

Result<SettingTree> tree_of(const YamlNode& node) {
  SettingTree tree;
  if (node.kind() == YamlKind::kScalar) {
    auto text = node.string();
    if (!text.ok()) return text.error();
    tree.kind = Kind::kScalar;
    tree.text = std::move(text).value();
  } else if (node.kind() == YamlKind::kList) {
    tree.kind = Kind::kList;
    for (const YamlNode& item : *node.items()) {
      auto inner = tree_of(item);
      if (!inner.ok()) return inner;
      tree.items.push_back(std::move(inner).value());
    }
  } else if (node.kind() == YamlKind::kMap) {
    tree.kind = Kind::kMap;
    for (const auto& entry : *node.entries()) {
      auto inner = tree_of(entry.value);
      if (!inner.ok()) return inner;
      tree.entries.emplace_back(entry.key, std::move(inner).value());
    }
  }
  return tree;
}

/// Whether YAML takes the text as it is, be it a word or a number.
bool is_plain(const std::string& text) {
  return !text.empty() &&
         text.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./") ==
             std::string::npos;
}

using Path = std::vector<std::string>;

/// Whether two maps are of one behaviour, or of none: then their entries are compared one by one.
bool are_of_one_behaviour(const SettingTree& a, const SettingTree& b) {
  const SettingTree* of_a = a.find("behaviour");
  const SettingTree* of_b = b.find("behaviour");
  if (of_a == nullptr || of_b == nullptr) return of_a == of_b;
  return of_a->text == of_b->text;
}

/// A part's choice is a map of one entry: its name, with its parameters.
bool are_of_one_name(const SettingTree& a, const SettingTree& b) {
  return a.kind == Kind::kMap && b.kind == Kind::kMap && a.entries.size() == 1 &&
         b.entries.size() == 1 && a.entries[0].first == b.entries[0].first;
}

bool are_of_the_same_names(const SettingTree& a, const SettingTree& b) {
  return std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(),
                    are_of_one_name);
}

Path below(const Path& path, const std::string& key) {
  Path inner = path;
  inner.push_back(key);
  return inner;
}

void compare(const SettingTree& a, const SettingTree& b, const Path& path,
             std::vector<SettingDifference>& found);

void compare_entries(const SettingTree& a, const SettingTree& b, const Path& path,
                     std::vector<SettingDifference>& found) {
  for (const auto& [key, value] : a.entries) {
    if (const SettingTree* other = b.find(key)) {
      compare(value, *other, below(path, key), found);
    } else {
      found.push_back({below(path, key), value, std::nullopt});
    }
  }
  for (const auto& [key, value] : b.entries) {
    if (a.find(key) == nullptr) found.push_back({below(path, key), std::nullopt, value});
  }
}

/// Stages are entries of the graph, and parts entries of a stage.
void compare(const SettingTree& a, const SettingTree& b, const Path& path,
             std::vector<SettingDifference>& found) {
  if (a.line() == b.line()) return;
  if (a.kind == Kind::kMap && b.kind == Kind::kMap) {
    const bool is_part = path.size() == 2;
    const bool one_by_one = is_part ? are_of_one_name(a, b) : are_of_one_behaviour(a, b);
    if (path.empty() || one_by_one) return compare_entries(a, b, path, found);
  }
  if (a.kind == Kind::kList && b.kind == Kind::kList && !a.items.empty() &&
      are_of_the_same_names(a, b)) {
    for (std::size_t i = 0; i < a.items.size(); ++i) {
      compare_entries(a.items[i], b.items[i], path, found);
    }
    return;
  }
  found.push_back({path, a, b});
}

void change(SettingTree& tree, const Path& path, std::size_t level,
            const std::optional<SettingTree>& value) {
  if (tree.kind == Kind::kList) {  // of choices: that of the name
    for (SettingTree& item : tree.items) {
      if (item.find(path[level]) != nullptr) change(item, path, level, value);
    }
    return;
  }
  const auto found = std::find_if(tree.entries.begin(), tree.entries.end(),
                                  [&](const auto& entry) { return entry.first == path[level]; });
  if (level + 1 < path.size()) {
    if (found != tree.entries.end()) change(found->second, path, level + 1, value);
  } else if (!value) {
    if (found != tree.entries.end()) tree.entries.erase(found);
  } else if (found == tree.entries.end()) {
    tree.entries.emplace_back(path[level], *value);
  } else {
    found->second = *value;
  }
}

}  // namespace

Result<SettingTree> SettingTree::parse(const std::string& yaml, const std::string& file) {
  const auto root = YamlNode::parse(yaml, file);
  return root.ok() ? tree_of(*root) : Result<SettingTree>(root.error());
}

const SettingTree* SettingTree::find(const std::string& key) const {
  for (const auto& [name, value] : entries) {
    if (name == key) return &value;
  }
  return nullptr;
}

std::string SettingTree::line() const {
  std::string all;
  switch (kind) {
    case Kind::kNothing:
      return "null";
    case Kind::kScalar:
      return is_plain(text) ? text : core::yaml_quoted(text);
    case Kind::kList:
      for (const SettingTree& item : items) all += (all.empty() ? "" : ", ") + item.line();
      return '[' + all + ']';
    case Kind::kMap:
      for (const auto& [key, value] : entries) {
        all += (all.empty() ? "" : ", ") + key + ": " + value.line();
      }
  }
  return '{' + all + '}';
}

std::string SettingDifference::name() const {
  std::string all;
  for (const std::string& key : path) all += (all.empty() ? "" : ".") + key;
  return all;
}

std::vector<SettingDifference> differences(const SettingTree& a, const SettingTree& b) {
  std::vector<SettingDifference> found;
  compare(a, b, {}, found);
  return found;
}

SettingTree with(const SettingTree& tree, const SettingDifference& difference) {
  SettingTree changed = tree;
  change(changed, difference.path, 0, difference.b);
  return changed;
}

}  // namespace clew::hunt
