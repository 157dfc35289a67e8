// The ABI note of a node library, read from the file as bytes. Nothing here trusts the file: every offset
// and length is checked against its size, since a damaged library must be refused and not loaded.
#include <elf.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include "ballflow/plugin.h"
#include "ballflow/registry.hpp"

namespace ballflow {

namespace {

static_assert(std::endian::native == std::endian::little);
#if defined(__x86_64__)
constexpr unsigned this_machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr unsigned this_machine = EM_AARCH64;
#else
#error "add the ELF machine number of this architecture"
#endif

class File {
 public:
  explicit File(const std::string& path)
      : descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    struct stat status {};
    if (descriptor_ < 0 || fstat(descriptor_, &status) != 0) {
      problem_ = std::string("cannot be read: ") + std::strerror(errno);
    } else if (!S_ISREG(status.st_mode)) {
      problem_ = "is no regular file";
    } else {
      size_ = static_cast<std::uint64_t>(status.st_size);
    }
  }
  ~File() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const std::string& problem() const { return problem_; }
  bool holds(std::uint64_t offset, std::uint64_t size) const {
    return offset <= size_ && size <= size_ - offset;
  }
  bool read(std::uint64_t offset, void* to, std::uint64_t size) const {
    if (!holds(offset, size)) return false;
    char* out = static_cast<char*>(to);
    while (size > 0) {
      const ssize_t got = pread(descriptor_, out, size, static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      out += got;
      offset += static_cast<std::uint64_t>(got);
      size -= static_cast<std::uint64_t>(got);
    }
    return true;
  }
  template <class T>
  bool read(std::uint64_t offset, T& value) const {
    return read(offset, &value, sizeof value);
  }

 private:
  int descriptor_;
  std::uint64_t size_ = 0;
  std::string problem_;
};

/// Is the zero-terminated text at `offset` of the string table equal to `name`?
bool name_is(const File& file, const Elf64_Shdr& table, std::uint64_t offset, std::string_view name) {
  char text[64];
  const std::uint64_t length = name.size() + 1;
  if (length > sizeof text || table.sh_type != SHT_STRTAB) return false;
  if (offset > table.sh_size || length > table.sh_size - offset) return false;
  if (table.sh_offset > std::numeric_limits<std::uint64_t>::max() - offset) return false;
  return file.read(table.sh_offset + offset, text, length) &&
         std::memcmp(text, name.data(), name.size()) == 0 && text[name.size()] == '\0';
}

}  // namespace

std::string refuse_plugin_file(const std::string& path) {
  const File file(path);
  if (!file.problem().empty()) return file.problem();

  unsigned char magic[SELFMAG];
  if (!file.read(0, magic) || std::memcmp(magic, ELFMAG, SELFMAG) != 0)
    return "is no ELF file (no shared library)";
  unsigned char ident[EI_NIDENT];
  if (!file.read(0, ident)) return "is truncated: its ELF header is cut off";
  if (ident[EI_CLASS] != ELFCLASS64) return "is a 32-bit library, this program is 64-bit";
  if (ident[EI_DATA] != ELFDATA2LSB) return "is a big-endian library, this program is little-endian";
  Elf64_Ehdr header;
  if (!file.read(0, header)) return "is truncated: its ELF header is cut off";
  if (header.e_machine != this_machine) {
    return "is built for another machine (ELF machine " + std::to_string(header.e_machine) +
           ", this program has " + std::to_string(this_machine) + ")";
  }
  if (header.e_type != ET_DYN) return "is an ELF file but no shared library";

  // Truncated contents would make the dynamic loader, not us, fall over.
  if (header.e_phentsize != sizeof(Elf64_Phdr)) return "is damaged: its program headers have a wrong size";
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment;
    if (header.e_phoff > std::numeric_limits<std::uint64_t>::max() / 2 ||
        !file.read(header.e_phoff + i * sizeof segment, segment)) {
      return "is truncated: its program headers are cut off";
    }
    if (segment.p_type == PT_LOAD && !file.holds(segment.p_offset, segment.p_filesz)) {
      return "is truncated: segment " + std::to_string(i) + " is cut off";
    }
  }

  if (header.e_shoff == 0) return "carries no ABI note: it has no section headers (do not strip them)";
  if (header.e_shentsize != sizeof(Elf64_Shdr)) return "is damaged: its section headers have a wrong size";
  const auto section = [&](std::uint64_t index) -> std::optional<Elf64_Shdr> {
    Elf64_Shdr result;
    constexpr std::uint64_t far = std::numeric_limits<std::uint64_t>::max() / 2;
    if (header.e_shoff > far || index > far / sizeof result) return std::nullopt;
    if (!file.read(header.e_shoff + index * sizeof result, result)) return std::nullopt;
    return result;
  };
  const std::optional<Elf64_Shdr> first = section(0);
  if (!first) return "is truncated: its section headers are cut off";
  // Counts that do not fit 16 bits are kept in section 0.
  const std::uint64_t count = header.e_shnum != 0 ? header.e_shnum : first->sh_size;
  const std::uint64_t names_index = header.e_shstrndx != SHN_XINDEX ? header.e_shstrndx : first->sh_link;
  const std::optional<Elf64_Shdr> names = section(names_index);
  if (!names || names_index >= count) return "is truncated: its section names are cut off";
  for (std::uint64_t i = 1; i < count; ++i) {
    const std::optional<Elf64_Shdr> candidate = section(i);
    if (!candidate) return "is truncated: its section headers are cut off";
    if (!name_is(file, *names, candidate->sh_name, BALLFLOW_ABI_SECTION)) continue;
    bf_abi_note note;
    if (candidate->sh_type == SHT_NOBITS || candidate->sh_size < sizeof note ||
        !file.read(candidate->sh_offset, note)) {
      return "is damaged: its ABI note is cut off";
    }
    if (std::memcmp(note.magic, BALLFLOW_ABI_MAGIC, sizeof note.magic) != 0)
      return "is damaged: its ABI note is unreadable";
    if (note.abi_version != BALLFLOW_ABI_VERSION) {
      return "is built for plugin ABI " + std::to_string(note.abi_version) +
             ", this program has plugin ABI " + std::to_string(BALLFLOW_ABI_VERSION) +
             ": rebuild it against the headers of this version";
    }
    return {};
  }
  return "is no node library: it has no section " BALLFLOW_ABI_SECTION
         " (see BALLFLOW_PLUGIN in ballflow/sdk.hpp)";
}

}  // namespace ballflow
