// Projects and the product data of workpieces: people, organizations, dates, approvals, security.

#include "tests/files/exchange/ap238/resources/resource_support.h"

namespace capstan::exchange::ap238 {
namespace {

// --- project ---

TEST(Project, HasAnOwnerWithAnAddress) {
  check({"owner",
         [](Bench& b) {
           model::Model& m = b.plan.model;
           b.step(model::OptionalStop{});
           model::Address address;
           address.internal_location = "3.14";
           address.street_number = "5";
           address.street = "Weg";
           address.postal_box = "77";
           address.town = "Erlangen";
           address.region = "By";
           address.postal_code = "91054";
           address.country = "DE";
           address.facsimile_number = "1";
           address.telephone_number = "2";
           address.electronic_mail_address = "a@b";
           address.telex_number = "3";
           model::PersonAndAddress owner;
           owner.its_person = person(m);
           owner.its_address = m.add(std::move(address));
           m.at<model::Project>(b.plan.project).its_owner = m.add(std::move(owner));
         },
         {"APPLIED_PERSON_AND_ORGANIZATION_ASSIGNMENT(#,#,(#));", "PERSON_AND_ORGANIZATION_ROLE('owner');",
          "PERSON_AND_ORGANIZATION(#,#);",
          "PERSON('4711','Noether','Emmy',('Amalie'),('Prof.','Dr.'),('ForMem'));",
          "PERSONAL_ADDRESS('3.14','5','Weg','77','Erlangen','By','91054','DE','1','2','a@b','3',(#),$);"}});
}

TEST(Project, HasAnOwnerInAnOrganization) {
  check({"owner",
         [](Bench& b) {
           b.step(model::OptionalStop{});
           b.plan.model.at<model::Project>(b.plan.project).its_owner = member(b.plan.model);
         },
         {"PERSON_AND_ORGANIZATION_ROLE('owner');", "ORGANIZATION('ORG','Works','where it is made');"}});
}

TEST(Project, HasAReleaseDateAStatusAndATimeOfItsLastChange) {
  check({"release",
         [](Bench& b) {
           model::Model& m = b.plan.model;
           b.step(model::OptionalStop{});
           model::Approval approval;
           approval.level = "released";
           model::ApprovalStatus status;
           status.name = "approved";
           approval.status = m.add(std::move(status));
           model::LastModifiedTimestamp stamp;
           stamp.assigned_date = moment(m);
           stamp.role = "last modified";
           auto& p = m.at<model::Project>(b.plan.project);
           p.its_release = moment(m);
           p.its_status = m.add(std::move(approval));
           p.last_modified_timestamp = m.add(std::move(stamp));
         },
         {"APPLIED_DATE_AND_TIME_ASSIGNMENT(#,#,(#));", "DATE_TIME_ROLE('release date');",
          "DATE_TIME_ROLE('last modified');", "CALENDAR_DATE(2024,29,2);", "LOCAL_TIME(23,59,7.5,#);",
          "COORDINATED_UNIVERSAL_TIME_OFFSET(5,30,.AHEAD.);", "APPLIED_APPROVAL_ASSIGNMENT(#,(#));",
          "APPROVAL(#,'released');", "APPROVAL_STATUS('approved');"}});
}

// --- workpiece ---

TEST(Workpiece, HasApprovalsWithDatesAndApprovers) {
  const auto approval = [](model::Model& m, const char* level) {
    model::ApprovalStatus status;
    status.name = "approved";
    model::ApprovingPersonOrganization approver;
    approver.person_organization = member(m);
    approver.role = "approver";
    model::Approval out;
    out.level = level;
    out.status = m.add(std::move(status));
    out.approval_date_time = moment(m);
    out.approvers.push_back(m.add(std::move(approver)));
    return m.add(std::move(out));
  };
  const auto all = [&](model::Model& m, model::Workpiece& w) {
    w.its_approvals.push_back(approval(m, "definition"));
    w.revision_approvals.push_back(approval(m, "revision"));
    w.product_approvals.push_back(approval(m, "product"));
    w.product_approvals.push_back(approval(m, "product again"));
  };
  check(workpiece_case("approvals", all,
                       {"APPLIED_APPROVAL_ASSIGNMENT(#,(#));", "APPROVAL(#,'definition');",
                        "APPROVAL(#,'revision');", "APPROVAL(#,'product again');", "APPROVAL_DATE_TIME(#,#);",
                        "APPROVAL_PERSON_ORGANIZATION(#,#,#);", "APPROVAL_ROLE('approver');"}));
}

TEST(Workpiece, HasPeopleOrganizationsAndDates) {
  using W = model::Workpiece;
  using People = model::RefList<model::PersonOrganizationAssignment> W::*;
  using Dates = model::RefList<model::DateTimeAssignment> W::*;
  const auto people = [](const char* what, People list) {
    return workpiece_case(
        what,
        [list](model::Model& m, W& w) {
          model::PersonOrganizationAssignment a;
          a.assigned_person_organization = member(m);
          a.role = "creator";
          (w.*list).push_back(m.add(std::move(a)));
        },
        {"APPLIED_PERSON_AND_ORGANIZATION_ASSIGNMENT(#,#,(#));", "PERSON_AND_ORGANIZATION_ROLE('creator');"});
  };
  const auto orgs = [](const char* what, People list) {
    return workpiece_case(what,
                          [list](model::Model& m, W& w) {
                            model::PersonOrganizationAssignment a;
                            a.assigned_person_organization = organization(m);
                            a.role = "supplier";
                            (w.*list).push_back(m.add(std::move(a)));
                          },
                          {"APPLIED_ORGANIZATION_ASSIGNMENT(#,#,(#));", "ORGANIZATION_ROLE('supplier');"});
  };
  const auto dates = [](const char* what, Dates list) {
    return workpiece_case(
        what,
        [list](model::Model& m, W& w) {
          model::OrdinalDate date;
          date.year_component = 2024;
          date.day_component = 60;
          model::DateTimeAssignment a;
          a.assigned_date = m.add(std::move(date));
          a.role = "ordered";
          (w.*list).push_back(m.add(std::move(a)));
        },
        {"APPLIED_DATE_ASSIGNMENT(#,#,(#));", "DATE_ROLE('ordered');", "ORDINAL_DATE(2024,60);"});
  };
  const auto times = [](const char* what, Dates list) {
    return workpiece_case(what,
                          [list](model::Model& m, W& w) {
                            model::DateTimeAssignment a;
                            a.assigned_date = moment(m);
                            a.role = "creation_date";
                            (w.*list).push_back(m.add(std::move(a)));
                          },
                          {"APPLIED_DATE_AND_TIME_ASSIGNMENT(#,#,(#));", "DATE_TIME_ROLE('creation_date');"});
  };
  check(people("its_people", &W::its_people));
  check(people("revision_people", &W::revision_people));
  check(people("product_people", &W::product_people));
  check(orgs("its_orgs", &W::its_orgs));
  check(orgs("revision_orgs", &W::revision_orgs));
  check(orgs("product_orgs", &W::product_orgs));
  check(dates("its_datestamps", &W::its_datestamps));
  check(dates("revision_datestamps", &W::revision_datestamps));
  check(dates("product_datestamps", &W::product_datestamps));
  check(times("its_timestamps", &W::its_timestamps));
  check(times("revision_timestamps", &W::revision_timestamps));
  check(times("product_timestamps", &W::product_timestamps));
}

TEST(Workpiece, HasCategoriesSecurityAndATimeOfItsLastChange) {
  check(workpiece_case("categories",
                       [](auto&, auto& w) {
                         w.its_categories = {.items = {"rawpiece", "fixture"}, .given = true};
                       },
                       {"PRODUCT_RELATED_PRODUCT_CATEGORY('rawpiece',$,(#));",
                        "PRODUCT_RELATED_PRODUCT_CATEGORY('fixture',$,(#));"}));
  check(workpiece_case(
      "security",
      [](auto& m, auto& w) {
        model::SecurityClassification s;
        s.name = "drawing";
        s.purpose = "export";
        s.security_level = "confidential";
        w.its_security_classifications.push_back(m.add(std::move(s)));
      },
      {"APPLIED_SECURITY_CLASSIFICATION_ASSIGNMENT(#,(#));", "SECURITY_CLASSIFICATION('drawing','export',#);",
       "SECURITY_CLASSIFICATION_LEVEL('confidential');"}));
  check(workpiece_case("last modified beside another time",
                       [](auto& m, auto& w) {
                         model::LastModifiedTimestamp last;
                         last.assigned_date = moment(m);
                         last.role = "last modified";
                         model::DateTimeAssignment other;
                         other.assigned_date = moment(m);
                         other.role = "creation_date";
                         w.last_modified_timestamp = m.add(std::move(last));
                         w.its_timestamps.push_back(m.add(std::move(other)));
                       },
                       {"DATE_TIME_ROLE('last modified');", "DATE_TIME_ROLE('creation_date');"}));
}

}  // namespace
}  // namespace capstan::exchange::ap238
