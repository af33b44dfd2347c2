// SPDX-License-Identifier: Apache-2.0
#include "log/log.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <mutex>
#include <system_error>
#include <vector>

#include "core/nearest_name.hpp"
#include "core/terminal_text.hpp"

namespace clew::logs {
namespace {

constexpr std::array<std::string_view, 5> kNames = {"debug", "info", "warning", "error", "off"};

// A user's eye wants the time of day, a file the date and what all machines agree on.
constexpr char kShownWithTimes[] = "%H:%M:%S.%e %l %n: %v";
constexpr char kShown[] = "%n: %v";
constexpr char kWritten[] = "%Y-%m-%dT%H:%M:%S.%eZ %l %n[%P]: %v";

spdlog::level::level_enum to_spdlog(Level level) {
  constexpr std::array kLevels = {spdlog::level::debug, spdlog::level::info, spdlog::level::warn,
                                  spdlog::level::err, spdlog::level::off};
  return kLevels[static_cast<std::size_t>(level)];
}

Level from_spdlog(spdlog::level::level_enum level) {
  if (level <= spdlog::level::debug) return Level::kDebug;
  if (level == spdlog::level::info) return Level::kInfo;
  return level == spdlog::level::warn ? Level::kWarning : Level::kError;
}

/// Standard error, unbuffered like every other word that goes there. A reader that has gone is no
/// reason to say more.
class ShownSink : public spdlog::sinks::base_sink<std::mutex> {
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    std::fwrite(line.data(), 1, line.size(), stderr);
  }
  void flush_() override { std::fflush(stderr); }
};

/// In our words, and at once: spdlog would try five times.
core::Result<void> check_writable(const std::string& path) {
  std::FILE* const file = std::fopen(path.c_str(), "ab");
  if (file == nullptr) {
    return core::Error{"cannot be written as a log: " + std::generic_category().message(errno),
                       path};
  }
  std::fclose(file);
  return {};
}

class ListenerSink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  using Listener = std::function<void(Level, const std::string&)>;
  void set(Listener listener) {
    const std::lock_guard<std::mutex> lock(mutex_);
    listener_ = std::move(listener);
  }

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::string text(message.payload.data(), message.payload.size());
    if (listener_) listener_(from_spdlog(message.level), text);
  }
  void flush_() override {}

  Listener listener_;
};

void set_pattern(spdlog::sinks::sink& sink, const char* pattern, spdlog::pattern_time_type time) {
  sink.set_formatter(std::make_unique<spdlog::pattern_formatter>(pattern, time));
}

/// Where a process's lines go. Sinks are made once; `open` may replace the file and the logger.
class Outputs {
 public:
  Outputs() {
    set_pattern(*shown_, kShown, spdlog::pattern_time_type::local);
    listener_->set_level(spdlog::level::info);
    begin("clew");
  }

  core::Result<void> open(const Settings& settings) {
    std::shared_ptr<spdlog::sinks::sink> file;
    std::string path = settings.file;
    try {
      if (!settings.directory.empty()) path = path_in(settings);
      if (!path.empty()) {
        CLEW_RETURN_IF_ERROR(check_writable(path));
        file = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path);
      }
    } catch (const spdlog::spdlog_ex& error) {
      return core::Error{error.what(), path};
    } catch (const std::filesystem::filesystem_error& error) {
      return core::Error{"cannot be made to log into: " + error.code().message(),
                         settings.directory};
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    file_ = std::move(file);
    if (file_) {
      set_pattern(*file_, kWritten, spdlog::pattern_time_type::utc);
      file_->set_level(to_spdlog(settings.written));
    }
    const auto time = spdlog::pattern_time_type::local;
    set_pattern(*shown_, settings.times ? kShownWithTimes : kShown, time);
    shown_->set_level(to_spdlog(settings.shown));
    begin(settings.speaker);
    return {};
  }

  bool shows(Level level) const { return shown_->should_log(to_spdlog(level)); }
  void listen(ListenerSink::Listener listener) { listener_->set(std::move(listener)); }

  void tell(Level level, std::string_view text) {
    logger()->log(to_spdlog(level), "{}", core::terminal_text(text));
  }

  void complain(std::string_view text) {
    std::fprintf(stderr, "clew: %s\n", core::terminal_lines(text).c_str());
    const auto level = spdlog::level::err;
    const std::string name = logger()->name();
    const std::string line = core::terminal_text(text);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!file_ || !file_->should_log(level)) return;
    try {
      file_->log(spdlog::details::log_msg(name, level, line));
      file_->flush();
    } catch (const spdlog::spdlog_ex&) {  // a full disk: the user has the line
    }
  }

 private:
  static std::string path_in(const Settings& settings) {
    std::filesystem::create_directories(settings.directory);
    std::string name = settings.file_name;
    for (char& c : name) {
      const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
      if (!plain) c = '-';
    }
    std::array<char, 32> time{};
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::strftime(time.data(), time.size(), "%Y%m%dT%H%M%SZ", &utc);
    return settings.directory + fmt::format("/{}-{}-{}.log", name, time.data(), ::getpid());
  }

  void begin(const std::string& speaker) {
    std::vector<spdlog::sink_ptr> sinks = {shown_, listener_};
    if (file_) sinks.push_back(file_);
    auto logger = std::make_shared<spdlog::logger>(speaker, sinks.begin(), sinks.end());
    logger->set_level(spdlog::level::debug);
    // What is told is told now: the process may be killed next.
    logger->flush_on(spdlog::level::debug);
    logger->set_error_handler([](const std::string& why) {
      static std::once_flag told;
      std::call_once(told, [&] { std::fprintf(stderr, "clew: the log: %s\n", why.c_str()); });
    });
    logger_ = std::move(logger);
  }

  std::shared_ptr<spdlog::logger> logger() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return logger_;
  }

  mutable std::mutex mutex_;
  const std::shared_ptr<ShownSink> shown_ = std::make_shared<ShownSink>();
  const std::shared_ptr<ListenerSink> listener_ = std::make_shared<ListenerSink>();
  std::shared_ptr<spdlog::sinks::sink> file_;
  std::shared_ptr<spdlog::logger> logger_;
};

/// Lives as long as the process: a thread may log while it ends.
Outputs& outputs() {
  static auto* const all = new Outputs;
  return *all;
}

}  // namespace

core::Result<Level> level_from_name(const std::string& name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<Level>(i);
  }
  return core::Error{core::unknown_name("level", name, {kNames.begin(), kNames.end()})};
}

std::string_view level_name(Level level) { return kNames[static_cast<std::size_t>(level)]; }

core::Result<void> open(const Settings& settings) { return outputs().open(settings); }

bool shows(Level level) { return outputs().shows(level); }

void listen(std::function<void(Level, const std::string&)> listener) {
  outputs().listen(std::move(listener));
}

void tell(Level level, std::string_view text) { outputs().tell(level, text); }

void complain(std::string_view text) { outputs().complain(text); }

}  // namespace clew::logs
