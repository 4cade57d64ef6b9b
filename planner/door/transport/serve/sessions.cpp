#include "planner/door/transport/serve/sessions.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace capstan::transport {
namespace {

void remove_folder(const std::string& folder) {
  std::error_code ignored;
  if (!folder.empty()) std::filesystem::remove_all(folder, ignored);
}

}  // namespace

Sessions::~Sessions() { remove_folder(folder_); }

Result<std::shared_ptr<ServedSession>> Sessions::open(const std::string& owner, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  forget_unused(now);
  const auto own = static_cast<std::size_t>(
      std::count_if(all_.begin(), all_.end(), [&](const auto& one) { return one.second->owner == owner; }));
  if (all_.size() >= limits_.sessions || own >= limits_.sessions_of_user)
    return fail({.code = "SERVE-SESSIONS",
                 .message = std::to_string(own) + " sessions of this user are open, " +
                            std::to_string(all_.size()) + " in all",
                 .expected = "at most " + std::to_string(limits_.sessions_of_user) + " and " +
                             std::to_string(limits_.sessions),
                 .hint = "close one (DELETE)"});
  if (::mkdir(folder_.c_str(), 0700) != 0 && errno != EEXIST)
    return fail({.code = "SERVE-FOLDER",
                 .message = "no folder for sessions can be made: " + std::string(std::strerror(errno)),
                 .file = folder_});
  auto made = std::make_shared<ServedSession>();
  made->id = "s" + std::to_string(++last_);
  made->owner = owner;
  made->folder = folder_ + "/" + made->id;
  made->used = now;
  std::error_code ec;
  if (!std::filesystem::create_directory(made->folder, ec))
    return fail("SERVE-FOLDER", "no folder for the session can be made: " + ec.message());
  all_.emplace(made->id, made);
  return made;
}

std::shared_ptr<ServedSession> Sessions::find(const std::string& id, const std::string& peer,
                                              Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  forget_unused(now);
  const auto at = all_.find(id);
  if (at == all_.end() || at->second->owner != peer) return nullptr;
  at->second->used = now;
  return at->second;
}

void Sessions::close(const ServedSession& session) {
  const std::lock_guard lock(mutex_);
  const auto at = all_.find(session.id);
  if (at == all_.end()) return;
  at->second->session.stop();
  remove_folder(at->second->folder);
  all_.erase(at);
}

void Sessions::stop_all() {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, one] : all_) one->session.stop();
}

std::vector<std::string> Sessions::ids_of(const std::string& peer) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> out;
  for (const auto& [id, one] : all_)
    if (one->owner == peer) out.push_back(id);
  return out;
}

std::size_t Sessions::count() const {
  const std::lock_guard lock(mutex_);
  return all_.size();
}

void Sessions::forget_unused(Clock::time_point now) {
  for (auto at = all_.begin(); at != all_.end();) {
    // One that a call is in is held there, too.
    const bool unused = at->second.use_count() == 1 && now - at->second->used > limits_.session;
    if (unused) remove_folder(at->second->folder);
    at = unused ? all_.erase(at) : std::next(at);
  }
}

}  // namespace capstan::transport
