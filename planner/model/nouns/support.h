#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Measures, parameters, people, dates and approvals (ISO 10303-41, ISO 14649-10).
/// Lengths in mm, angles in rad, feeds in mm/min, spindle speeds in 1/min (negative is clockwise seen from
/// the spindle, as ISO 14649 signs it), times in s, ratios as fractions of one.

namespace capstan::model {

struct Approval : Noun {
  static constexpr TypeId kType = TypeId::kApproval;
  Ref<ApprovalStatus> status;
  Text level;
  Ref<DateAndTime> approval_date_time;             ///< optional, not in ISO 14649
  RefList<ApprovingPersonOrganization> approvers;  ///< optional, not in ISO 14649
};

struct ApprovalStatus : Noun {
  static constexpr TypeId kType = TypeId::kApprovalStatus;
  Text name;
};

struct DateAndTime : Noun {
  static constexpr TypeId kType = TypeId::kDateAndTime;
  Ref<Date> date_component;
  Ref<LocalTime> time_component;
};

struct Date : Noun {
  static constexpr TypeId kType = TypeId::kDate;
  Integer year_component;
};

struct CalendarDate : Date {
  static constexpr TypeId kType = TypeId::kCalendarDate;
  Integer day_component;
  Integer month_component;
};

struct OrdinalDate : Date {
  static constexpr TypeId kType = TypeId::kOrdinalDate;
  Integer day_component;
};

struct WeekOfYearAndDayDate : Date {
  static constexpr TypeId kType = TypeId::kWeekOfYearAndDayDate;
  Integer week_component;
  Integer day_component;  ///< optional
};

struct LocalTime : Noun {
  static constexpr TypeId kType = TypeId::kLocalTime;
  Integer hour_component;
  Integer minute_component;  ///< optional
  Real second_component;     ///< optional
  Ref<CoordinatedUniversalTimeOffset> zone;
};

struct CoordinatedUniversalTimeOffset : Noun {
  static constexpr TypeId kType = TypeId::kCoordinatedUniversalTimeOffset;
  Integer hour_offset;
  Integer minute_offset;  ///< optional
  Enumerated<AheadOrBehind> sense;
};

struct Person : Noun {
  static constexpr TypeId kType = TypeId::kPerson;
  Text id;
  Text last_name;          ///< optional
  Text first_name;         ///< optional
  TextList middle_names;   ///< optional
  TextList prefix_titles;  ///< optional
  TextList suffix_titles;  ///< optional
};

struct Address : Noun {
  static constexpr TypeId kType = TypeId::kAddress;
  Text internal_location;        ///< optional
  Text street_number;            ///< optional
  Text street;                   ///< optional
  Text postal_box;               ///< optional
  Text town;                     ///< optional
  Text region;                   ///< optional
  Text postal_code;              ///< optional
  Text country;                  ///< optional
  Text facsimile_number;         ///< optional
  Text telephone_number;         ///< optional
  Text electronic_mail_address;  ///< optional
  Text telex_number;             ///< optional
};

struct TolerancedLengthMeasure : Noun {
  static constexpr TypeId kType = TypeId::kTolerancedLengthMeasure;
  Real theoretical_size;  ///< mm
  OneOf<PlusMinusValue, LimitsAndFits> implicit_tolerance;
};

struct PlusMinusValue : Noun {
  static constexpr TypeId kType = TypeId::kPlusMinusValue;
  Real upper_limit;  ///< mm
  Real lower_limit;  ///< mm
  Integer significant_digits;
};

struct LimitsAndFits : Noun {
  static constexpr TypeId kType = TypeId::kLimitsAndFits;
  Real deviation;                            ///< mm
  Real grade;                                ///< mm
  Enumerated<FittingType> its_fitting_type;  ///< optional
  Text form_variance;                        ///< optional, not in ISO 14649; the letter: "H"
  Text zone_variance;                        ///< optional, not in ISO 14649; "hole" or "shaft"
  Text tolerance_grade;                      ///< optional, not in ISO 14649; "7"
  Text source;                               ///< optional, not in ISO 14649
};

struct PersonAndAddress : Noun {
  static constexpr TypeId kType = TypeId::kPersonAndAddress;
  Ref<Person> its_person;
  Ref<Address> its_address;  ///< optional
};

struct PropertyParameter : Noun {
  static constexpr TypeId kType = TypeId::kPropertyParameter;
  Text parameter_name;
};

struct DescriptiveParameter : PropertyParameter {
  static constexpr TypeId kType = TypeId::kDescriptiveParameter;
  Text descriptive_string;
};

struct NumericParameter : PropertyParameter {
  static constexpr TypeId kType = TypeId::kNumericParameter;
  Real its_parameter_value;
  Text its_parameter_unit;
};

struct SurfaceTextureParameter : Noun {
  static constexpr TypeId kType = TypeId::kSurfaceTextureParameter;
  Real its_value;
  Text parameter_name;
  Text measuring_method;
  Text parameter_index;  ///< optional
  RefList<MachinedSurface> applied_surfaces;
  Text its_id;                                               ///< optional, not in ISO 14649
  Ref<Workpiece> its_workpiece;                              ///< optional, not in ISO 14649
  OneOfList<ManufacturingFeature, ShapeElement> applied_to;  ///< optional, not in ISO 14649
};

struct CurveWithNormalVector : Noun {
  static constexpr TypeId kType = TypeId::kCurveWithNormalVector;
  Ref<BoundedCurve> basiccurve;
  Ref<BoundedCurve> surface_normal;
};

struct Organization : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kOrganization;
  Text its_id;  ///< optional
  Text name;
  Text description;  ///< optional
};

/// A person in an organization, as product data names owners and signatories.
struct PersonAndOrganization : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kPersonAndOrganization;
  Ref<Person> its_person;
  Ref<Organization> its_organization;
  Text description;  ///< optional
};

struct ApprovingPersonOrganization : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kApprovingPersonOrganization;
  OneOf<PersonAndOrganization, PersonAndAddress, Organization> person_organization;
  Text role;  ///< optional
};

struct PersonOrganizationAssignment : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kPersonOrganizationAssignment;
  OneOf<PersonAndOrganization, PersonAndAddress, Organization> assigned_person_organization;
  Text role;
};

struct DateTimeAssignment : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kDateTimeAssignment;
  OneOf<DateAndTime, Date> assigned_date;
  Text role;  ///< optional
};

/// When, and by whom, an object was last changed; the role is "last modified".
struct LastModifiedTimestamp : DateTimeAssignment {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kLastModifiedTimestamp;
  OneOf<PersonAndOrganization, PersonAndAddress, Organization> modified_by;  ///< optional
};

struct SecurityClassification : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kSecurityClassification;
  Text name;
  Text purpose;  ///< optional
  Text security_level;
};

}  // namespace capstan::model
