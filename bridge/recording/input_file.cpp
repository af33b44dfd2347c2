// SPDX-License-Identifier: Apache-2.0
#include "recording/input_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <list>
#include <mutex>
#include <utility>

#include "recording/piece_files.hpp"

namespace clew::bridge::mcap {
namespace {

constexpr std::size_t kWindowBytes = 1 << 18;

}  // namespace

std::string why_not_opened(int error_number) {
  const std::string why = std::strerror(error_number);
  struct rlimit limit {};
  if (error_number != EMFILE || ::getrlimit(RLIMIT_NOFILE, &limit) != 0) return why;
  return why + "; this process may have " + std::to_string(limit.rlim_cur) + " (ulimit -n)";
}

class InputFile::Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

/// Those of a process that are open, the one that was read last in front.
class OpenFiles {
 public:
  using Descriptor = InputFile::Descriptor;

  /// Of this process, and never destroyed: a file may be closed last of all.
  static OpenFiles& instance() {
    static auto& files = *new OpenFiles;
    return files;
  }

  /// The open file; opens it if it is closed, and closes others for it.
  core::Result<std::shared_ptr<const Descriptor>> use(const InputFile& file) {
    const std::lock_guard lock(mutex_);
    if (file.descriptor_) {
      const auto place = std::find(open_.begin(), open_.end(), &file);
      open_.splice(open_.begin(), open_, place);
      return file.descriptor_;
    }
    auto descriptor = file.open_again();
    if (!descriptor.ok()) return descriptor.error();
    add(file, *descriptor);
    return descriptor;
  }

  /// open(2) for reading. If the process has no descriptor left, all files held here are closed
  /// first.
  int open(const std::string& path) {
    // A pipe that nobody writes would keep open waiting for ever.
    constexpr int kFlags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;
    const int number = ::open(path.c_str(), kFlags);
    if (number >= 0 || errno != EMFILE || open_.empty()) return number;
    close_all_but(0);
    return ::open(path.c_str(), kFlags);
  }

  void forget(const InputFile& file) {
    const std::lock_guard lock(mutex_);
    if (file.descriptor_) open_.remove(&file);
  }

  std::mutex& mutex() { return mutex_; }

  void add(const InputFile& file, std::shared_ptr<const Descriptor> descriptor) {
    close_all_but(InputFile::kMostOpen - 1);
    file.descriptor_ = std::move(descriptor);
    open_.push_front(&file);
  }

 private:
  void close_all_but(std::size_t count) {
    while (open_.size() > count) {
      open_.back()->descriptor_.reset();  // a thread that reads it keeps it for as long
      open_.pop_back();
    }
  }

  std::mutex mutex_;
  std::list<const InputFile*> open_;
};

core::Result<std::shared_ptr<const InputFile>> InputFile::open(const std::string& path) {
  OpenFiles& files = OpenFiles::instance();
  const std::lock_guard lock(files.mutex());
  const int number = files.open(path);
  if (number < 0) return core::Error{"cannot be read: " + why_not_opened(errno), path};
  auto descriptor = std::make_shared<const Descriptor>(number);
  struct stat status {};
  if (::fstat(number, &status) != 0 || !S_ISREG(status.st_mode)) {
    return core::Error{
        "is no regular file: a recording is read from a file, not from a pipe, a device or a "
        "directory",
        path};
  }
  std::shared_ptr<InputFile> file(new InputFile(path));
  file->size_ = static_cast<std::uint64_t>(status.st_size);
  file->device_ = status.st_dev;
  file->inode_ = status.st_ino;
  files.add(*file, std::move(descriptor));
  return std::shared_ptr<const InputFile>(std::move(file));
}

/// Of a file that its recorder has finished since, the name that it grew under is gone.
core::Result<std::shared_ptr<const InputFile::Descriptor>> InputFile::open_again() const {
  OpenFiles& files = OpenFiles::instance();
  int number = files.open(path_);
  if (number < 0 && errno == ENOENT) number = files.open(piece_path(path_, 0));
  if (number < 0) return error("cannot be read again: " + why_not_opened(errno));
  auto descriptor = std::make_shared<const Descriptor>(number);
  struct stat status {};
  const bool same =
      ::fstat(number, &status) == 0 && status.st_dev == device_ && status.st_ino == inode_;
  if (!same) return error("is another file than when it was opened");
  return std::shared_ptr<const Descriptor>(std::move(descriptor));
}

InputFile::~InputFile() { OpenFiles::instance().forget(*this); }

core::Result<void> InputFile::read(std::uint64_t offset, std::size_t bytes,
                                   ByteBuffer& buffer) const {
  CLEW_CHECK(offset <= size_ && bytes <= size_ - offset,
             std::to_string(bytes) + " bytes at " + std::to_string(offset) + " of " + path_ +
                 ", which has " + std::to_string(size_));
  const auto descriptor = OpenFiles::instance().use(*this);
  if (!descriptor.ok()) return descriptor.error();
  char* out = buffer.resize(bytes);
  std::size_t left = bytes;
  while (left > 0) {
    const ssize_t got =
        ::pread((*descriptor)->number(), out, left, static_cast<off_t>(offset + (bytes - left)));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return error(std::string("cannot be read: ") + std::strerror(errno));
    if (got == 0) return error("has become shorter while it was read");
    out += got;
    left -= static_cast<std::size_t>(got);
  }
  return {};
}

core::Result<std::string_view> FileWindow::view(std::uint64_t offset, std::size_t bytes) {
  const bool inside = offset >= start_ && offset - start_ <= buffer_.size() &&
                      bytes <= buffer_.size() - (offset - start_);
  if (!inside) {
    const std::uint64_t wanted = std::max<std::uint64_t>(bytes, kWindowBytes);
    const std::uint64_t available = std::min(wanted, file_->size() - offset);
    const auto read = file_->read(offset, static_cast<std::size_t>(available), buffer_);
    if (!read.ok()) {
      buffer_.resize(0);
      return read.error();
    }
    start_ = offset;
  }
  return buffer_.view().substr(static_cast<std::size_t>(offset - start_), bytes);
}

}  // namespace clew::bridge::mcap
