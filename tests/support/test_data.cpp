#include "test_data.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace ballflow::test {

namespace fs = std::filesystem;

std::string data_file(const std::string& relative) {
  const char* folder = std::getenv("BALLFLOW_TEST_DATA");
  const fs::path root =
      folder != nullptr ? fs::path(folder) : fs::path(BALLFLOW_SOURCE_DIR) / "../shared/data";
  const fs::path path = root / relative;
  std::error_code ignored;
  return fs::exists(path, ignored) ? fs::weakly_canonical(path).string() : std::string();
}

std::string source_file(const std::string& relative) {
  return (fs::path(BALLFLOW_SOURCE_DIR) / relative).string();
}
std::string binary_file(const std::string& relative) {
  return (fs::path(BALLFLOW_BINARY_DIR) / relative).string();
}

TempFolder::TempFolder() {
  std::string pattern = (fs::temp_directory_path() / "ballflow-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot create a temporary folder");
  path_ = pattern;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_file(const std::string& path, const std::string& content) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << content;
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace ballflow::test
