// Names of what a graph has several of: variants of a sweep, copies of a map.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ballflow {

/// Text that can be part of a path of a node and of the name of a folder: no / [ ] , = and blanks, short.
std::string label_text(const std::string& text);

/// A label for each of the texts, all different. Of paths the names of the files, where those differ.
std::vector<std::string> labels_of(const std::vector<std::string>& texts, bool files);

/// Cuts a text to so many bytes and marks it, so that different texts stay different.
std::string cut(const std::string& text, std::size_t longest);

}  // namespace ballflow
