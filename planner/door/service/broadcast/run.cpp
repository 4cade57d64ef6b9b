#include "planner/door/service/broadcast/run.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace capstan::service {

void BroadcastRun::plan_changed(bool bound) {
  stale_ = true;
  fresh_ = fresh_ || !bound;
}

Result<std::vector<BroadcastLine>> BroadcastRun::tell(
    const ControlEvent& event, bool over, const std::function<std::optional<Broadcasts>()>& make) {
  if (stale_) {
    if (auto made = make()) {
      if (broadcasts_ && !fresh_) made->take_over(*broadcasts_);
      broadcasts_ = std::move(made);
      stale_ = fresh_ = false;
    }
  }
  if (!broadcasts_)
    return fail({.code = "BROADCAST-PLAN",
                 .message = "there is no plan whose broadcasts could be sent, or it is being bound",
                 .hint = "bring a plan first"});
  if (over) return broadcasts_->finish(event);
  return broadcasts_->tell(event);
}

Status take_measured(const std::string& name, const std::string& json, ControlEvent& event) {
  constexpr int kMostLevels = 8;  // as of the server's requests (serve/wire/json_request.h)
  bool deep = false;
  const auto shallow = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    deep = deep || depth > kMostLevels;
    return depth <= kMostLevels;
  };
  const auto value = nlohmann::json::parse(json, shallow, false);
  const auto fault = [&](const char* expected) {
    return fail({.code = "BROADCAST-VALUE",
                 .message = "the measured '" + name + "' is " + json.substr(0, 40),
                 .expected = expected});
  };
  if (deep) return fault("at most 8 levels");
  if (value.is_discarded()) return fault("a value in JSON: 1200.5, \"text\", [1, 2, 3]");
  if (name == "location") {
    if (!value.is_array() || value.size() != 3 ||
        !std::all_of(value.begin(), value.end(), [](const auto& v) { return v.is_number(); }))
      return fault("[x, y, z] in mm");
    event.location_mm = {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
  }
  event.measured[name] = value.dump();
  return {};
}

}  // namespace capstan::service
