// An upstream in a folder that many machines share.
#pragma once

#include "ballflow/upstream.hpp"
#include "store/folders.hpp"

namespace ballflow {

class UpstreamFolder final : public Upstream {
 public:
  UpstreamFolder(std::string place, std::shared_ptr<FileSystem> files);

  const std::string& place() const override { return place_; }
  Read get(Room room, const Digest& name, const Sink& sink, bool afresh) override;
  std::optional<std::uint64_t> size(Room room, const Digest& name) override;
  Written put(Room room, const Digest& name, const std::vector<std::span<const std::byte>>& pieces,
              const PutOptions& options) override;
  bool set_aside(Room room, const Digest& name) override;

 private:
  OpenFile folder(Room room, const std::string& hex, bool create) const;
  OpenFile subfolder(int parent, const std::string& name, bool create) const;
  int publish(const OpenFile& shard, const std::string& draft, const std::string& name) const;
  int write_draft(const OpenFile& shard, const std::string& draft,
                  const std::vector<std::span<const std::byte>>& pieces, const PutOptions& options) const;

  std::string place_;
  std::shared_ptr<FileSystem> files_;
  OpenFile root_;
  mode_t mode_ = 0;  // of the root: who may look in may read its files, who may write there may everywhere
};

}  // namespace ballflow
