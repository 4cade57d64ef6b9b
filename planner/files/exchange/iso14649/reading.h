#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "planner/files/exchange/common/noun_faults.h"
#include "planner/files/exchange/common/report.h"
#include "planner/files/p21/file.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

/// State while one file is read.
struct Reading {
  const p21::File& file;
  model::Plan& plan;
  Reporter& reporter;

  std::vector<model::AnyRef> object_of;  ///< by instance index of the file
  std::set<std::string> draft;           ///< what showed that the file is at the draft level

  std::vector<Doubt> doubts;
  bool sealed = false;  ///< the file is unedited since Capstan wrote it (seal.h)

  [[nodiscard]] model::AnyRef find(std::uint64_t id) const {
    const auto instance = file.find(id);
    return instance ? object_of[instance->index()] : model::AnyRef{};
  }
  /// `attribute`: as Doubt's.
  void doubt(model::AnyRef object, Diagnostic d, std::string_view attribute = {}) {
    doubts.push_back({object, std::move(d), std::string(attribute)});
  }
  /// The parameter an attribute was read from; omitted when the object did not come from the file.
  [[nodiscard]] p21::Value parameter(model::AnyRef object, std::string_view attribute) const;
};

/// Makes one object per instance, fills its attributes, keeps what no noun describes.
void read_objects(Reading& reading);

}  // namespace capstan::exchange
