// Where tests find things.
#pragma once

#include <string>

namespace ballflow::test {

/// Path of a real model ("models/fandisk.off.gz") in the folder of test data, or empty when the folder or the
/// file is absent: the test then says GTEST_SKIP(). The folder is $BALLFLOW_TEST_DATA, else ../shared/data
/// beside the source tree.
std::string data_file(const std::string& relative);

/// Path of a file of the source tree.
std::string source_file(const std::string& relative);

/// Path of a file of the build tree ("bin/ballflow").
std::string binary_file(const std::string& relative);

/// A fresh empty folder that disappears with the object.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& content);

}  // namespace ballflow::test
