// SPDX-License-Identifier: Apache-2.0
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/nearest_name.hpp"
#include "hunt/property_node.hpp"

namespace clew::hunt {
namespace {

using core::Error;
using core::Result;
using Node = Property::Node;
using NodePtr = std::shared_ptr<const Node>;

enum class TokenKind { kName, kNumber, kSymbol, kEnd };

struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string text;
  double number = 0.0;
  int column = 0;  ///< from 1
};

/// What a node is: a number to calculate with, a statement that holds or not, or a field of words.
enum class Meaning { kNumber, kStatement, kWord };

struct Parsed {
  NodePtr node;
  Meaning meaning = Meaning::kNumber;
  int column = 0;
};

NodePtr make(Operation operation, NodePtr left, NodePtr right = nullptr) {
  Node node;
  node.operation = operation;
  node.left = std::move(left);
  node.right = std::move(right);
  return std::make_shared<const Node>(std::move(node));
}

NodePtr make_number(double number) {
  Node node;
  node.number = number;
  return std::make_shared<const Node>(std::move(node));
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The tokens of a text one after the other.
class Lexer {
 public:
  Lexer(std::string_view text, std::string source) : text_(text), source_(std::move(source)) {}

  Error error(int column, std::string message) const {
    return {std::move(message), source_, 1, column};
  }

  Result<Token> next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    Token token;
    token.column = static_cast<int>(at_) + 1;
    if (at_ == text_.size()) return token;
    const char c = text_[at_];
    if (is_letter(c)) return name(token);
    if (is_digit(c) || c == '.') return number(token);
    return symbol(token);
  }

 private:
  Result<Token> name(Token token) {
    const std::size_t from = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    token.kind = TokenKind::kName;
    token.text = text_.substr(from, at_ - from);
    return token;
  }

  Result<Token> number(Token token) {
    const char* first = text_.data() + at_;
    const char* last = text_.data() + text_.size();
    const auto read = std::from_chars(first, last, token.number);
    if (read.ec != std::errc() || !std::isfinite(token.number)) {
      return error(token.column, "expected a finite number");
    }
    at_ += static_cast<std::size_t>(read.ptr - first);
    if (at_ < text_.size() && (is_letter(text_[at_]) || text_[at_] == '.')) {
      return error(static_cast<int>(at_) + 1, "a number ends here; expected an operator, found '" +
                                                  std::string(1, text_[at_]) + "'");
    }
    token.kind = TokenKind::kNumber;
    token.text = std::string(first, read.ptr);
    return token;
  }

  Result<Token> symbol(Token token) {
    token.kind = TokenKind::kSymbol;
    for (const char* two : {"==", "!=", "<=", ">="}) {
      if (text_.substr(at_, 2) != two) continue;
      token.text = two;
      at_ += 2;
      return token;
    }
    const char c = text_[at_];
    if (c == '=') return error(token.column, "found '='; equality is '=='");
    if (c == '&' || c == '|' || c == '!') {
      return error(token.column, std::string("found '") + c + "'; allowed: and, or, not, !=");
    }
    if (std::string_view("<>+-*/()").find(c) == std::string_view::npos) {
      const bool is_printable = static_cast<unsigned char>(c) >= ' ' && c != '\x7f';
      const std::string what = is_printable ? "'" + std::string(1, c) + "'" : "a control character";
      return error(token.column, "found " + what +
                                     "; allowed: fields, words, numbers, and, or, not, ==, !=, <, "
                                     "<=, >, >=, +, -, *, /, ( and )");
    }
    token.text = std::string(1, c);
    ++at_;
    return token;
  }

  std::string_view text_;
  std::string source_;
  std::size_t at_ = 0;
};

std::vector<std::string> field_names() {
  std::vector<std::string> names;
  for (const FieldInfo& info : fields()) names.push_back(info.name);
  return names;
}

std::optional<Field> field_called(const std::string& name) {
  for (std::size_t i = 0; i < kFields; ++i) {
    if (fields()[i].name == name) return static_cast<Field>(i);
  }
  return std::nullopt;
}

std::optional<Operation> comparison_of(const Token& token) {
  static const std::pair<const char*, Operation> kAll[] = {
      {"==", Operation::kEqual},  {"!=", Operation::kUnequal}, {"<", Operation::kLess},
      {"<=", Operation::kAtMost}, {">", Operation::kGreater},  {">=", Operation::kAtLeast}};
  if (token.kind != TokenKind::kSymbol) return std::nullopt;
  for (const auto& [text, operation] : kAll) {
    if (token.text == text) return operation;
  }
  return std::nullopt;
}

std::string found_text(const Token& token) {
  return token.kind == TokenKind::kEnd ? "the end" : "'" + token.text + "'";
}

/// By recursive descent, a function a rule of the grammar.
class Parser {
 public:
  explicit Parser(Lexer lexer) : lexer_(std::move(lexer)) {}

  Result<NodePtr> parse() {
    CLEW_RETURN_IF_ERROR(advance());
    const auto all = disjunction();
    if (!all.ok()) return all.error();
    if (token_.kind != TokenKind::kEnd) return unexpected("and, or, or the end");
    CLEW_RETURN_IF_ERROR(expect(*all, Meaning::kStatement));
    return all->node;
  }

 private:
  using Rule = Result<Parsed> (Parser::*)();

  Result<void> advance() {
    auto token = lexer_.next();
    if (!token.ok()) return token.error();
    token_ = std::move(token).value();
    return {};
  }

  bool is_symbol(const char* text) const {
    return token_.kind == TokenKind::kSymbol && token_.text == text;
  }
  bool is_word(const char* text) const {
    return token_.kind == TokenKind::kName && token_.text == text;
  }
  Error unexpected(const std::string& allowed) const {
    return lexer_.error(token_.column, "found " + found_text(token_) + "; expected " + allowed);
  }

  Result<void> expect(const Parsed& parsed, Meaning meaning) const {
    if (parsed.meaning == meaning) return {};
    if (parsed.meaning == Meaning::kWord) {
      return lexer_.error(parsed.column, "a field of words is compared by == or != with one of: " +
                                             words_of(parsed.node->field));
    }
    return lexer_.error(parsed.column, meaning == Meaning::kNumber
                                           ? "this holds or not; expected a number"
                                           : "this is a number; expected a comparison or a flag");
  }

  static std::string words_of(Field field) {
    std::string all;
    for (const std::string& word : fields()[static_cast<std::size_t>(field)].words) {
      all += (all.empty() ? "" : ", ") + word;
    }
    return all;
  }

  Result<Parsed> joined(const char* word, Operation operation, Rule rule) {
    auto left = (this->*rule)();
    while (left.ok() && is_word(word)) {
      CLEW_RETURN_IF_ERROR(expect(*left, Meaning::kStatement));
      CLEW_RETURN_IF_ERROR(advance());
      const auto right = (this->*rule)();
      if (!right.ok()) return right.error();
      CLEW_RETURN_IF_ERROR(expect(*right, Meaning::kStatement));
      left->node = make(operation, left->node, right->node);
    }
    return left;
  }

  Result<Parsed> disjunction() {
    if (++depth_ > Property::kDeepest) {
      return lexer_.error(
          token_.column,
          "nested too deep; at most " + std::to_string(Property::kDeepest) + " levels are allowed");
    }
    auto all = joined("or", Operation::kOr, &Parser::conjunction);
    --depth_;
    return all;
  }

  Result<Parsed> conjunction() { return joined("and", Operation::kAnd, &Parser::negation); }

  Result<Parsed> negation() {
    int negations = 0;
    const int column = token_.column;
    for (; is_word("not"); ++negations) CLEW_RETURN_IF_ERROR(advance());
    auto parsed = comparison();
    if (!parsed.ok() || negations == 0) return parsed;
    CLEW_RETURN_IF_ERROR(expect(*parsed, Meaning::kStatement));
    if (negations % 2 != 0) parsed->node = make(Operation::kNot, parsed->node);
    parsed->column = column;
    return parsed;
  }

  Result<Parsed> comparison() {
    auto left = sum();
    if (!left.ok()) return left;
    const auto operation = comparison_of(token_);
    if (!operation) return left;
    const Token sign = token_;
    CLEW_RETURN_IF_ERROR(advance());
    const bool of_words = left->meaning == Meaning::kWord;
    auto compared =
        of_words ? word_comparison(*left, *operation, sign) : number_comparison(*left, *operation);
    if (compared.ok() && comparison_of(token_)) {
      return lexer_.error(token_.column, "comparisons do not chain; join two of them by 'and'");
    }
    return compared;
  }

  Result<Parsed> number_comparison(const Parsed& left, Operation operation) {
    CLEW_RETURN_IF_ERROR(expect(left, Meaning::kNumber));
    const auto right = sum();
    if (!right.ok()) return right.error();
    CLEW_RETURN_IF_ERROR(expect(*right, Meaning::kNumber));
    return Parsed{make(operation, left.node, right->node), Meaning::kStatement, left.column};
  }

  Result<Parsed> word_comparison(const Parsed& left, Operation operation, const Token& sign) {
    if (operation != Operation::kEqual && operation != Operation::kUnequal) {
      return lexer_.error(sign.column, "words have no order; allowed: ==, !=");
    }
    const FieldInfo& info = fields()[static_cast<std::size_t>(left.node->field)];
    if (token_.kind != TokenKind::kName) {
      return unexpected("one of: " + words_of(left.node->field));
    }
    for (std::size_t i = 0; i < info.words.size(); ++i) {
      if (info.words[i] != token_.text) continue;
      CLEW_RETURN_IF_ERROR(advance());
      return Parsed{make(operation, left.node, make_number(static_cast<double>(i))),
                    Meaning::kStatement, left.column};
    }
    return lexer_.error(token_.column, core::unknown_name(info.name, token_.text, info.words));
  }

  Result<Parsed> calculated(const char* first, Operation of_first, const char* second,
                            Operation of_second, Rule rule) {
    auto left = (this->*rule)();
    while (left.ok() && (is_symbol(first) || is_symbol(second))) {
      const Operation operation = is_symbol(first) ? of_first : of_second;
      CLEW_RETURN_IF_ERROR(expect(*left, Meaning::kNumber));
      CLEW_RETURN_IF_ERROR(advance());
      const auto right = (this->*rule)();
      if (!right.ok()) return right.error();
      CLEW_RETURN_IF_ERROR(expect(*right, Meaning::kNumber));
      left->node = make(operation, left->node, right->node);
    }
    return left;
  }

  Result<Parsed> sum() {
    return calculated("+", Operation::kAdd, "-", Operation::kSubtract, &Parser::product);
  }
  Result<Parsed> product() {
    return calculated("*", Operation::kMultiply, "/", Operation::kDivide, &Parser::factor);
  }

  Result<Parsed> factor() {
    const int column = token_.column;
    bool is_negative = false;
    for (; is_symbol("-"); is_negative = !is_negative) CLEW_RETURN_IF_ERROR(advance());
    auto parsed = is_symbol("(") ? parenthesised() : value();
    if (!parsed.ok() || !is_negative) return parsed;
    CLEW_RETURN_IF_ERROR(expect(*parsed, Meaning::kNumber));
    return Parsed{make(Operation::kMinus, parsed->node), Meaning::kNumber, column};
  }

  Result<Parsed> parenthesised() {
    CLEW_RETURN_IF_ERROR(advance());
    auto inside = disjunction();
    if (!inside.ok()) return inside;
    if (!is_symbol(")")) return unexpected("')'");
    CLEW_RETURN_IF_ERROR(advance());
    return inside;
  }

  Result<Parsed> value() {
    const Token token = token_;
    if (token.kind == TokenKind::kNumber) {
      CLEW_RETURN_IF_ERROR(advance());
      return Parsed{make_number(token.number), Meaning::kNumber, token.column};
    }
    const bool is_operator = is_word("and") || is_word("or") || is_word("not");
    if (token.kind != TokenKind::kName || is_operator) {
      return unexpected("a field, a number or '('");
    }
    const auto field = field_called(token.text);
    if (!field) {
      return lexer_.error(token.column, core::unknown_name("field", token.text, field_names()));
    }
    CLEW_RETURN_IF_ERROR(advance());
    Node node;
    node.operation = Operation::kField;
    node.field = *field;
    const FieldType type = fields()[static_cast<std::size_t>(*field)].type;
    const Meaning meaning = type == FieldType::kFlag   ? Meaning::kStatement
                            : type == FieldType::kWord ? Meaning::kWord
                                                       : Meaning::kNumber;
    return Parsed{std::make_shared<const Node>(std::move(node)), meaning, token.column};
  }

  Lexer lexer_;
  Token token_;
  std::size_t depth_ = 0;
};

}  // namespace

Result<Property> Property::parse(std::string_view text, const std::string& source) {
  if (text.size() > kMostLength) {
    return Error{"is " + std::to_string(text.size()) + " bytes long; at most " +
                     std::to_string(kMostLength) + " are allowed",
                 source};
  }
  auto root = Parser(Lexer(text, source)).parse();
  if (!root.ok()) return root.error();
  return Property(std::string(text), std::move(root).value());
}

}  // namespace clew::hunt
