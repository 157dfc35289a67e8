// The files of a graph: each is read once, however often it is included.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "document/findings.hpp"
#include "document/graph_file.hpp"

namespace ballflow {

constexpr std::size_t max_subgraph_depth = 50;

class GraphFiles {
 public:
  /// `findings`: about the files themselves. `top` is the name of the first file.
  GraphFiles(const std::string& top, Findings& findings) : names_{top}, findings_(findings) {}

  /// As in messages, in order of first reading.
  const std::vector<std::string>& names() const { return names_; }

  /// The file `name` that `includer` names at `offset`, relative to itself; null when it cannot be used, and
  /// `findings` says why.
  const GraphFile* find(const GraphFile& includer, Offset offset, const std::string& name,
                        Findings& findings);

  // Files that are being included, outermost first: none of them can be included again, nor more than
  // max_subgraph_depth of them.
  void enter(const GraphFile& file);
  void leave() { chain_.pop_back(); }

 private:
  struct ChainLink {
    std::string key, name;
  };

  const std::string& canonical(const std::string& path);

  std::map<std::string, std::unique_ptr<GraphFile>> by_path_;  // canonical; null where it could not be read
  std::map<std::string, std::string> canonical_;               // memo: a file may be included a million times
  std::vector<std::string> names_;
  std::vector<ChainLink> chain_;
  Findings& findings_;
};

/// The content without a UTF-8 byte order mark. Throws Error when it cannot be read, or is in UTF-16. Not
/// more is read than the limit of texts and a block.
std::string read_text_file(const std::string& path);

}  // namespace ballflow
