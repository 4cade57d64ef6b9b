#include <algorithm>
#include <map>

#include "tooling/library/formats/all.h"
#include "tooling/library/formats/iso13399/iso13399.h"
#include "tooling/library/formats/xml.h"
#include "tooling/library/formats/zip.h"

// Packages of the generic tool classification: a zip of package_meta_data.xml, package_assortment.xml,
// product_data_files/*.p21, models and pictures. In packages of 2017 each file is a zip of its own within.

namespace capstan::tooling {
namespace {

std::string_view base_name(std::string_view path) {
  const auto slash = path.find_last_of("/\\");
  return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

bool wanted(std::string_view name) {
  const std::string_view base = base_name(name);
  return base == "package_assortment.xml" || base == "package_meta_data.xml" || base.ends_with(".p21") ||
         base.ends_with(".p21.zip") || base.ends_with(".xml.zip");
}
bool marks(std::string_view name) {
  const std::string_view base = base_name(name);
  return base == "package_assortment.xml" || base.ends_with(".p21") || base.ends_with(".p21.zip");
}

/// Entries with the zips within them opened, one level deep.
Result<std::vector<ZipEntry>> unpacked(std::string_view bytes, const std::string& file) {
  auto entries = read_zip(bytes, file, wanted);
  if (!entries) return entries;
  // One allowance for the package and all the archives within.
  ZipCaps left;
  const auto used = [&left](const std::vector<ZipEntry>& some) {
    left.entries -= std::min(left.entries, some.size());
    for (const ZipEntry& e : some) left.total_bytes -= std::min(left.total_bytes, e.bytes.size());
  };
  used(*entries);
  std::vector<ZipEntry> out;
  for (ZipEntry& e : *entries) {
    if (!is_zip(e.bytes)) {
      out.push_back(std::move(e));
      continue;
    }
    auto inner = read_zip(e.bytes, file + " (" + e.name + ")", wanted, left);
    if (!inner) return inner;
    used(*inner);
    for (ZipEntry& i : *inner) out.push_back(std::move(i));
  }
  return out;
}

struct Listed {
  std::string product_id, gtc_class, vendor_class;
};

/// package_assortment.xml: file name of the product data -> what it says.
Result<std::map<std::string, Listed>> assortment(const ZipEntry& e, const std::string& file) {
  auto root = parse_xml(e.bytes, file + " (" + e.name + ")");
  if (!root) return fail(root.error());
  std::map<std::string, Listed> out;
  for (const XmlNode& item : root->children) {
    if (item.name != "item") continue;
    std::string p21 = item.text_of("p21_file_name");
    if (p21.empty()) p21 = std::string(base_name(item.text_of("p21_file_url")));
    if (p21.empty())
      return fail({.code = "GTC-FORM",
                   .message = "the item '" + item.text_of("product_id") + "' names no file",
                   .file = file,
                   .line = item.line,
                   .path = e.name,
                   .expected = "p21_file_name"});
    out[std::string(base_name(p21))] = {item.text_of("product_id"), item.text_of("gtc_generic_class_id"),
                                        item.text_of("gtc_vendor_class_id")};
  }
  return out;
}

void merge(Imported& into, Imported one, const Listed* listed) {
  for (CatalogueItem& i : one.library.items) {
    if (listed != nullptr && !listed->vendor_class.empty())
      i.kept.emplace_back("gtc_vendor_class_id", listed->vendor_class);
    into.library.items.push_back(std::move(i));
  }
  for (Holder& h : one.library.holders) into.library.holders.push_back(std::move(h));
  const auto append = [](auto& to, auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(into.report.derived, one.report.derived);
  append(into.report.dropped, one.report.dropped);
  into.report.tools += one.report.tools;
}

bool recognises(std::string_view bytes, std::string_view file) {
  if (!is_zip(bytes)) return false;
  const auto found = read_zip(bytes, std::string(file), marks);
  return found && !found->empty();
}

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions& /*options*/,
                      Job& job) {
  auto entries = unpacked(bytes, file);
  if (!entries) return fail(entries.error());
  std::map<std::string, Listed> listed;
  Imported out;
  out.library.source = file;
  for (const ZipEntry& e : *entries) {
    const std::string_view base = base_name(e.name);
    if (base == "package_assortment.xml") {
      auto a = assortment(e, file);
      if (!a) return fail(a.error());
      listed = *std::move(a);
    } else if (base == "package_meta_data.xml") {
      auto root = parse_xml(e.bytes, file + " (" + e.name + ")");
      if (!root) return fail(root.error());
      for (const XmlNode& c : root->children)
        if (c.children.empty() && !c.text.empty())
          out.library.kept.emplace_back("package_meta_data/" + c.name, c.text);
    }
  }
  std::map<std::string, bool> met;
  for (const ZipEntry& e : *entries) {
    if (!e.name.ends_with(".p21")) continue;
    const std::string base(base_name(e.name));
    const auto at = listed.find(base);
    IsoReadOptions o;
    if (at != listed.end()) o = {at->second.gtc_class, at->second.product_id};
    met[base] = true;
    auto one = read_iso13399(e.bytes, file + " (" + e.name + ")", o, job);
    if (!one) return fail(one.error());
    merge(out, *std::move(one), at == listed.end() ? nullptr : &at->second);
  }
  for (const auto& [name, item] : listed)
    if (!met.contains(name))
      out.report.dropped.push_back({item.product_id, "", "its file " + name + " is not in the package"});
  if (out.library.items.empty() && out.library.holders.empty())
    return fail({.code = "GTC-FORM",
                 .message = "the package holds no product data",
                 .file = file,
                 .expected = "product_data_files/*.p21"});
  return out;
}

}  // namespace

const Format& gtc_format() {
  static const Format kFormat{.name = "gtc",
                              .title = "GTC package (ISO 13399)",
                              .endings = {".zip"},
                              .recognises = recognises,
                              .read = read};
  return kFormat;
}

}  // namespace capstan::tooling
