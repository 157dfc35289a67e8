#include "run/memory_budget.hpp"

namespace ballflow {

bool MemoryBudget::fits(std::uint64_t claim) const { return used_ <= bytes_ && claim <= bytes_ - used_; }

void MemoryBudget::take(std::size_t i, std::uint64_t claim) {
  claims_[i] = claim;
  used_ += claim;
}

bool MemoryBudget::start(std::size_t i, std::uint64_t claim, std::uint64_t reads_held,
                         const std::function<void()>& waits) {
  const std::lock_guard lock(mutex_);
  const bool passes = reads_held == 0 && !waiting_.empty() && waiting_.begin()->reads_held > 0;
  if (!passes && fits(claim)) {
    take(i, claim);
    return true;
  }
  waits();
  waiting_.insert({reads_held, i, claim});
  waiting_claims_.insert(claim);
  return false;
}

std::vector<std::size_t> MemoryBudget::end(std::size_t i) {
  const std::lock_guard lock(mutex_);
  const auto claim = claims_.find(i);
  used_ -= claim->second;
  claims_.erase(claim);
  return pick();
}

std::vector<std::size_t> MemoryBudget::admit_waiting() {
  const std::lock_guard lock(mutex_);
  return pick();
}

std::vector<std::size_t> MemoryBudget::start_one() {
  const std::lock_guard lock(mutex_);
  std::vector<std::size_t> taken;
  if (claims_.empty() && !waiting_.empty()) take_waiting(waiting_.begin(), taken);
  return taken;
}

/// All that fit, in order. One that frees what is held keeps back those behind it that would only add to it.
std::vector<std::size_t> MemoryBudget::pick() {
  std::vector<std::size_t> taken;
  bool reader_waits = false;
  for (auto one = waiting_.begin(); one != waiting_.end();) {
    if (!fits(*waiting_claims_.begin()) || (reader_waits && one->reads_held == 0)) break;
    if (fits(one->claim)) {
      one = take_waiting(one, taken);
    } else {
      reader_waits = reader_waits || one->reads_held > 0;
      ++one;
    }
  }
  return taken;
}

std::set<MemoryBudget::Waiting>::iterator MemoryBudget::take_waiting(std::set<Waiting>::iterator one,
                                                                     std::vector<std::size_t>& taken) {
  take(one->node, one->claim);
  taken.push_back(one->node);
  waiting_claims_.erase(waiting_claims_.find(one->claim));
  return waiting_.erase(one);
}

void MemoryBudget::hold(const ArtifactPtr& artifact) {
  const std::lock_guard lock(mutex_);
  if (held_[artifact.get()]++ == 0) used_ += artifact->file_size();
}

void MemoryBudget::share(const ArtifactPtr& artifact) {
  const std::lock_guard lock(mutex_);
  if (const auto found = held_.find(artifact.get()); found != held_.end()) ++found->second;
}

void MemoryBudget::let_go(const ArtifactPtr& artifact) {
  const std::lock_guard lock(mutex_);
  const auto found = held_.find(artifact.get());
  if (found == held_.end() || --found->second > 0) return;
  used_ -= artifact->file_size();
  held_.erase(found);
}

std::uint64_t MemoryBudget::held(const ArtifactPtr& artifact) const {
  const std::lock_guard lock(mutex_);
  return held_.count(artifact.get()) != 0 ? artifact->file_size() : 0;
}

}  // namespace ballflow
