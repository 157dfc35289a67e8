#include "ballflow/upstream.hpp"

#include <filesystem>

#include "store/upstream_folder.hpp"
#include "store/upstream_http.hpp"

namespace ballflow {

std::shared_ptr<Upstream> Upstream::open(const std::string& place, std::shared_ptr<FileSystem> files) {
  if (is_address(place)) return std::make_shared<UpstreamHttp>(place);
  if (files == nullptr) files = std::make_shared<FileSystem>();
  std::error_code ignored;
  std::string path = std::filesystem::absolute(place, ignored).string();
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return std::make_shared<UpstreamFolder>(std::move(path), std::move(files));
}

}  // namespace ballflow
