#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "planner/files/exchange/common/report.h"
#include "planner/files/exchange/records/seal.h"
#include "planner/files/p21/file.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

// Contents of a plan beside its nouns (who bound what, identities, machine, material, cutters, stock,
// set-ups, steps, unplanned features, provenance), described once. Each standard carries them in its own way:
// ISO 14649 as user-defined header entities, ISO 10303-238 as process properties.

namespace capstan::exchange {

/// A missing or malformed field of a record; thrown by a carrier that reads, caught per record by the caller
/// of `restore_record`.
struct MalformedRecord {};

/// One record of a file, to be written or read field by field, in an order that both agree on. Fields have
/// names that wear their unit where `unit` is kNone.
class RecordFields {
 public:
  virtual ~RecordFields() = default;
  virtual void text(std::string_view name, std::string& v) = 0;
  virtual void real(std::string_view name, model::Unit unit, double& v) = 0;
  virtual void optional_real(std::string_view name, model::Unit unit, std::optional<double>& v) = 0;
  virtual void whole(std::string_view name, int& v) = 0;
  virtual void truth(std::string_view name, bool& v) = 0;
  /// An application object; reading leaves it unset if it is gone. Returns the file's name of it.
  virtual std::string object(std::string_view name, model::AnyRef& v) = 0;
  /// A decision: an object's attribute.
  virtual void decision(std::string_view name, model::DecisionKey& v) = 0;
  virtual void reason(model::Reason& v) = 0;
  /// Fields that belong together, until `end`.
  virtual void group() = 0;
  /// A list of `n` elements, each begun by `element`, until `end`. Gives how many there are.
  virtual std::size_t list(std::string_view name, std::size_t n) = 0;
  virtual void element(std::size_t i) = 0;
  virtual void end() = 0;
  /// Whether the record goes on: files of earlier versions may end here.
  [[nodiscard]] virtual bool more() { return true; }
};

/// Which records a file takes.
struct RecordSink {
  /// Position of the object in the file, 0: not in it. Records follow that order.
  std::function<std::uint64_t(model::AnyRef)> order;
  /// A record of a kind ("BINDING") about an object (unset: the whole plan), whose fields `describe` gives.
  std::function<void(std::string_view kind, model::AnyRef about,
                     const std::function<void(RecordFields&)>& describe)>
      record;
  bool enabled = true;  ///< whether `enabled` needs a record
};

/// Everything the plan knows, record by record, in a stable order. Hashes are taken from `written`, the model
/// as the file will hold it.
void write_plan_records(const model::Plan& plan, const model::Model& written, const RecordSink& sink);

/// Says something about the record being read.
using SayOfRecord = std::function<void(Severity, std::string code, std::string message)>;

/// Puts a record back into the plan; false for an unknown kind. A record of an object that is gone is dropped
/// with the note EXC-RECORD. `label` names the record in messages. In a sealed file (seal.h), which is
/// unedited, values are not compared: the rounding of a unit is no edit.
/// Fails   throws MalformedRecord.
bool restore_record(std::string_view kind, std::string_view label, RecordFields& fields, model::Plan& plan,
                    bool sealed, const SayOfRecord& say);

/// When all records are read: values that were edited since (model/plan/decision/edited.h) count as given,
/// with the note EXC-EDITED.
void settle_edits(model::Plan& plan, Reporter& reporter);
/// When all is read: exact paths where their seal holds, and else paths of which an edit would be lost are a
/// contradiction (exact_paths.h); lists that were edited in what is `called` so are a
/// contradiction; the steps come as the workplan has them, and where the records have them otherwise, warns
/// EXC-ORDER, once.
void settle_written(const p21::File& file, const SealState& seal, std::string_view called, model::Plan& plan,
                    Reporter& reporter);

}  // namespace capstan::exchange
