#include "planner/ground/memo/memo.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "planner/ground/memo/folder.h"

namespace capstan::memo {

Key key_of_bytes(Stage stage, std::string_view bytes) {
  const XXH128_hash_t h =
      XXH3_128bits_withSeed(bytes.data(), bytes.size(), static_cast<XXH64_hash_t>(stage) + 1);
  return {h.high64, h.low64};
}

Memo::Memo(std::size_t most_bytes) : most_bytes_(most_bytes) {}
Memo::~Memo() = default;

Result<std::shared_ptr<Memo>> Memo::in_folder(const std::string& folder, std::size_t most_bytes,
                                              std::size_t most_in_folder) {
  auto opened = Folder::open(folder, most_in_folder);
  if (!opened) return tl::unexpected(opened.error());
  auto out = std::make_shared<Memo>(most_bytes);
  out->folder_ = std::make_unique<Folder>(*std::move(opened));
  return out;
}

void Memo::put(const Key& key, std::shared_ptr<const std::string> bytes) {
  if (bytes->size() > most_bytes_) return;
  if (const auto at = entries_.find(key); at != entries_.end()) {
    bytes_ -= at->second.bytes->size();
    used_.erase(at->second.used);
    entries_.erase(at);
  }
  while (bytes_ + bytes->size() > most_bytes_ && !used_.empty()) {
    const auto oldest = entries_.find(used_.front());
    bytes_ -= oldest->second.bytes->size();
    entries_.erase(oldest);
    used_.pop_front();
  }
  bytes_ += bytes->size();
  used_.push_back(key);
  entries_.emplace(key, Entry{std::move(bytes), std::prev(used_.end())});
}

std::shared_ptr<const std::string> Memo::find(Stage stage, const Key& key) {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto at = entries_.find(key); at != entries_.end()) {
      used_.splice(used_.end(), used_, at->second.used);
      ++counts_[static_cast<std::size_t>(stage)].found;
      return at->second.bytes;
    }
  }
  if (!folder_) return nullptr;
  auto bytes = folder_->find(key);
  if (!bytes) return nullptr;
  auto shared = std::make_shared<const std::string>(*std::move(bytes));
  const std::scoped_lock lock(mutex_);
  put(key, shared);
  ++counts_[static_cast<std::size_t>(stage)].found;
  return shared;
}

void Memo::keep(Stage stage, const Key& key, std::string bytes) {
  if (folder_) folder_->keep(key, bytes);
  const std::scoped_lock lock(mutex_);
  ++counts_[static_cast<std::size_t>(stage)].made;
  put(key, std::make_shared<const std::string>(std::move(bytes)));
}

void Memo::reject(Stage stage) {
  const std::scoped_lock lock(mutex_);
  --counts_[static_cast<std::size_t>(stage)].found;
}

Counts Memo::counts(Stage stage) const {
  const std::scoped_lock lock(mutex_);
  return counts_[static_cast<std::size_t>(stage)];
}

std::size_t Memo::bytes() const {
  const std::scoped_lock lock(mutex_);
  return bytes_;
}

}  // namespace capstan::memo
