#include "ballflow/output_file.hpp"

#include <charconv>
#include <filesystem>
#include <optional>
#include <span>
#include <system_error>

#include "ballflow/error.hpp"
#include "base/draft.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = 1 << 16;
constexpr int attempts = 8;  // at a temporary name that nobody has

}  // namespace

struct OutputFile::Target {
  std::shared_ptr<FileSystem> files;
  OpenFile direct;   // a pipe or a device
  OpenFile folder;   // else: where the file will be,
  std::string name;  // under this name
  std::optional<Draft> draft;
};

OutputFile::OutputFile(const std::string& path, std::shared_ptr<FileSystem> files)
    : path_(path), target_(std::make_unique<Target>()) {
  Target& target = *target_;
  target.files = files != nullptr ? std::move(files) : std::make_shared<FileSystem>();
  std::error_code ignored;
  if (fs::is_symlink(path_, ignored)) {
    // What cannot be resolved is a pipe or a device behind /dev/stdout, or points nowhere and is replaced.
    if (const fs::path real = fs::canonical(path_, ignored); !ignored) path_ = real.string();
  }
  const fs::file_status status = fs::status(path_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    target.direct = {*target.files,
                     target.files->open(FileSystem::working_folder, path_, O_WRONLY | O_NOCTTY)};
    if (!target.direct.is_open()) fail(target.direct.get());
    struct stat opened {};
    const int error = target.files->status(target.direct.get(), opened);
    if (error < 0) fail(error);
    // Somebody has put a file there meanwhile, whose content must not be written over in part.
    if (S_ISREG(opened.st_mode)) fail(-EEXIST);
  } else {
    const fs::path whole = path_;
    const std::string parent = whole.has_parent_path() ? whole.parent_path().string() : ".";
    target.name = whole.filename().string();
    target.folder = {*target.files,
                     target.files->open(FileSystem::working_folder, parent, O_PATH | O_DIRECTORY)};
    if (!target.folder.is_open()) fail(target.folder.get());
    if (target.name.empty() || target.name == "." || target.name == "..") fail(-EISDIR);
    for (int attempt = 0; attempt < attempts; ++attempt) {
      target.draft.emplace(*target.files, target.folder.get(), temporary_name(*target.files, target.name),
                           0666);
      if (target.draft->made() != -EEXIST) break;
    }
    if (target.draft->made() < 0) fail(target.draft->made());
  }
  buffer_.reserve(buffer_size);
}

OutputFile::~OutputFile() = default;

void OutputFile::write(const void* data, std::size_t size) {
  if (buffer_.size() + size > buffer_size) flush();
  if (size > buffer_size) {
    write_through(static_cast<const char*>(data), size);
  } else {
    buffer_.append(static_cast<const char*>(data), size);
  }
}

OutputFile& OutputFile::operator<<(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return *this << std::string_view(text, static_cast<std::size_t>(end - text));
}

void OutputFile::commit() {
  flush();
  const int result = target_->draft ? target_->draft->publish(target_->folder.get(), target_->name, true)
                                    : target_->direct.close();
  if (result < 0) fail(result);
}

void OutputFile::flush() {
  write_through(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void OutputFile::write_through(const char* data, std::size_t size) {
  if (target_->draft) {
    if (const int error = target_->draft->write(std::as_bytes(std::span(data, size))); error < 0) fail(error);
    return;
  }
  while (size > 0) {
    const ssize_t written = target_->files->write(target_->direct.get(), data, size);
    if (written <= 0) fail(written < 0 ? static_cast<int>(written) : -EIO);
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

void OutputFile::fail(int negative_errno) const {
  throw Error(ExitCode::store,
              "cannot write " + path_ + ": " + std::generic_category().message(-negative_errno),
              "choose a place that exists, can be written and has space left");
}

void write_atomically(const std::string& path, std::string_view content) {
  OutputFile file(path);
  file << content;
  file.commit();
}

}  // namespace ballflow
