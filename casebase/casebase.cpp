#include "casebase/casebase.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "casebase/index/index.h"
#include "casebase/store.h"

namespace capstan::casebase {
namespace {

/// The cases of one combination of categories.
struct Bucket {
  std::vector<std::size_t> rows;  // into the cases, rising: so by id
  std::unique_ptr<Index> index;
};

}  // namespace

struct CaseBase::Impl {
  explicit Impl(Store s) : store(std::move(s)) {}

  Store store;
  std::vector<Case> cases;
  std::map<std::string, Bucket> buckets;

  void build() {
    buckets.clear();
    for (std::size_t row = 0; row < cases.size(); ++row)
      buckets[bucket_of(cases[row].asked)].rows.push_back(row);
    for (auto& [key, bucket] : buckets) {
      std::vector<Point> points;
      points.reserve(bucket.rows.size());
      for (const std::size_t row : bucket.rows) points.push_back(point_of(cases[row].asked));
      bucket.index = make_index(std::move(points));
    }
  }

  const Bucket* bucket(const Question& q) const {
    const auto found = buckets.find(bucket_of(q));
    return found == buckets.end() ? nullptr : &found->second;
  }
};

namespace {

Result<std::string> path_of(const std::string& uri) {
  constexpr std::string_view kPrefix = "sqlite:";
  const std::string path = uri.starts_with(kPrefix) ? uri.substr(kPrefix.size()) : uri;
  const bool other = path.find("://") != std::string::npos;
  if (path.empty() || other || path.find('\0') != std::string::npos) {
    return fail(Diagnostic{.code = "CASE-URI",
                           .message = "'" + uri.substr(0, 200) + "' names no case base",
                           .expected = "a path, or sqlite: and a path"});
  }
  return path;
}

}  // namespace

CaseBase::CaseBase(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CaseBase::CaseBase(CaseBase&&) noexcept = default;
CaseBase& CaseBase::operator=(CaseBase&&) noexcept = default;
CaseBase::~CaseBase() = default;

namespace {

Result<Store> open_store(const std::string& uri, Store::Missing missing, Job& job) {
  const Result<std::string> path = path_of(uri);
  if (!path) return fail(path.error());
  return Store::open(*path, missing, job);
}

}  // namespace

Result<CaseBase> CaseBase::open(const std::string& uri, Job& job) {
  Result<Store> store = open_store(uri, Store::Missing::kRefuse, job);
  if (!store) return fail(store.error());
  auto impl = std::make_unique<Impl>(std::move(*store));
  impl->cases = impl->store.take_cases();
  impl->build();
  return CaseBase(std::move(impl));
}

Result<CaseBase> CaseBase::open_or_create(const std::string& uri, Job& job) {
  Result<Store> store = open_store(uri, Store::Missing::kCreate, job);
  if (!store) return fail(store.error());
  auto impl = std::make_unique<Impl>(std::move(*store));
  impl->cases = impl->store.take_cases();
  impl->build();
  return CaseBase(std::move(impl));
}

Status CaseBase::add(const Case& c) { return add(std::span(&c, 1)); }

Status CaseBase::add(std::span<const Case> added) {
  std::vector<Case> checked(added.begin(), added.end());
  for (std::size_t i = 0; i < checked.size(); ++i) {
    if (const auto wrong = fault_of(checked[i])) {
      return fail(Diagnostic{.code = "CASE-INVALID",
                             .message = "case " + std::to_string(i + 1) + " of " +
                                        std::to_string(checked.size()) + " cannot be: " + *wrong});
    }
    checked[i].id = id_of(checked[i]);
  }
  if (checked.empty()) return {};
  if (Status s = impl_->store.add(checked); !s) return s;

  const auto by_id = [](const Case& a, const Case& b) { return a.id < b.id; };
  const auto same_id = [](const Case& a, const Case& b) { return a.id == b.id; };
  std::vector<Case>& all = impl_->cases;
  all.insert(all.end(), std::make_move_iterator(checked.begin()), std::make_move_iterator(checked.end()));
  std::sort(all.begin(), all.end(), by_id);
  all.erase(std::unique(all.begin(), all.end(), same_id), all.end());
  impl_->build();
  return {};
}

Result<std::vector<Neighbour>> CaseBase::nearest(const Question& q, std::size_t k) const {
  if (const auto wrong = fault_of(q)) return fail("CASE-INVALID", "the question cannot be: " + *wrong);
  std::vector<Neighbour> found;
  if (const Bucket* bucket = impl_->bucket(q)) {
    for (const Hit& hit : bucket->index->nearest(point_of(q), k)) {
      found.push_back({impl_->cases[bucket->rows[hit.row]], std::sqrt(hit.distance2)});
    }
  }
  return found;
}

std::size_t CaseBase::size() const { return impl_->cases.size(); }
const std::vector<Case>& CaseBase::cases() const { return impl_->cases; }

}  // namespace capstan::casebase
