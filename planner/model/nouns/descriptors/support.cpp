#include "planner/model/nouns/support.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

constexpr Attribute kApproval[] = {
    row<&Approval::status>("status", kRequired),
    row<&Approval::level>("level", kRequired),
    plan_row<&Approval::approval_date_time>("approval_date_time", kOptional),
    plan_row<&Approval::approvers>("approvers", kOptional),
};
constexpr Attribute kApprovalStatus[] = {
    row<&ApprovalStatus::name>("name", kRequired),
};
constexpr Attribute kDateAndTime[] = {
    row<&DateAndTime::date_component>("date_component", kRequired),
    row<&DateAndTime::time_component>("time_component", kRequired),
};
constexpr Attribute kDate[] = {
    row<&Date::year_component>("year_component", kRequired),
};
constexpr Attribute kCalendarDate[] = {
    row<&CalendarDate::day_component>("day_component", kRequired),
    row<&CalendarDate::month_component>("month_component", kRequired),
};
constexpr Attribute kOrdinalDate[] = {
    row<&OrdinalDate::day_component>("day_component", kRequired),
};
constexpr Attribute kWeekOfYearAndDayDate[] = {
    row<&WeekOfYearAndDayDate::week_component>("week_component", kRequired),
    row<&WeekOfYearAndDayDate::day_component>("day_component", kOptional),
};
constexpr Attribute kLocalTime[] = {
    row<&LocalTime::hour_component>("hour_component", kRequired),
    row<&LocalTime::minute_component>("minute_component", kOptional),
    row<&LocalTime::second_component>("second_component", kOptional),
    row<&LocalTime::zone>("zone", kRequired),
};
constexpr Attribute kCoordinatedUniversalTimeOffset[] = {
    row<&CoordinatedUniversalTimeOffset::hour_offset>("hour_offset", kRequired),
    row<&CoordinatedUniversalTimeOffset::minute_offset>("minute_offset", kOptional),
    row<&CoordinatedUniversalTimeOffset::sense>("sense", kRequired),
};
constexpr Attribute kPerson[] = {
    row<&Person::id>("id", kRequired),
    row<&Person::last_name>("last_name", kOptional),
    row<&Person::first_name>("first_name", kOptional),
    row<&Person::middle_names>("middle_names", kOptional),
    row<&Person::prefix_titles>("prefix_titles", kOptional),
    row<&Person::suffix_titles>("suffix_titles", kOptional),
};
constexpr Attribute kAddress[] = {
    row<&Address::internal_location>("internal_location", kOptional),
    row<&Address::street_number>("street_number", kOptional),
    row<&Address::street>("street", kOptional),
    row<&Address::postal_box>("postal_box", kOptional),
    row<&Address::town>("town", kOptional),
    row<&Address::region>("region", kOptional),
    row<&Address::postal_code>("postal_code", kOptional),
    row<&Address::country>("country", kOptional),
    row<&Address::facsimile_number>("facsimile_number", kOptional),
    row<&Address::telephone_number>("telephone_number", kOptional),
    row<&Address::electronic_mail_address>("electronic_mail_address", kOptional),
    row<&Address::telex_number>("telex_number", kOptional),
};
constexpr Attribute kTolerancedLengthMeasure[] = {
    row<&TolerancedLengthMeasure::theoretical_size>("theoretical_size", kRequired, Unit::kLength),
    row<&TolerancedLengthMeasure::implicit_tolerance>("implicit_tolerance", kRequired),
};
constexpr Attribute kPlusMinusValue[] = {
    row<&PlusMinusValue::upper_limit>("upper_limit", kRequired, Unit::kLength),
    row<&PlusMinusValue::lower_limit>("lower_limit", kRequired, Unit::kLength),
    row<&PlusMinusValue::significant_digits>("significant_digits", kRequired),
};
constexpr Attribute kLimitsAndFits[] = {
    row<&LimitsAndFits::deviation>("deviation", kRequired, Unit::kLength),
    row<&LimitsAndFits::grade>("grade", kRequired, Unit::kLength),
    row<&LimitsAndFits::its_fitting_type>("its_fitting_type", kOptional),
    plan_row<&LimitsAndFits::form_variance>("form_variance", kOptional),
    plan_row<&LimitsAndFits::zone_variance>("zone_variance", kOptional),
    plan_row<&LimitsAndFits::tolerance_grade>("tolerance_grade", kOptional),
    plan_row<&LimitsAndFits::source>("source", kOptional),
};
constexpr Attribute kPersonAndAddress[] = {
    row<&PersonAndAddress::its_person>("its_person", kRequired),
    row<&PersonAndAddress::its_address>("its_address", kOptional),
};
constexpr Attribute kPropertyParameter[] = {
    row<&PropertyParameter::parameter_name>("parameter_name", kRequired),
};
constexpr Attribute kDescriptiveParameter[] = {
    row<&DescriptiveParameter::descriptive_string>("descriptive_string", kRequired),
};
constexpr Attribute kNumericParameter[] = {
    row<&NumericParameter::its_parameter_value>("its_parameter_value", kRequired),
    row<&NumericParameter::its_parameter_unit>("its_parameter_unit", kRequired),
};
constexpr Attribute kSurfaceTextureParameter[] = {
    row<&SurfaceTextureParameter::its_value>("its_value", kRequired),
    row<&SurfaceTextureParameter::parameter_name>("parameter_name", kRequired),
    row<&SurfaceTextureParameter::measuring_method>("measuring_method", kRequired),
    row<&SurfaceTextureParameter::parameter_index>("parameter_index", kOptional),
    row<&SurfaceTextureParameter::applied_surfaces>("applied_surfaces", kRequired),
    plan_row<&SurfaceTextureParameter::its_id>("its_id", kOptional),
    plan_row<&SurfaceTextureParameter::its_workpiece>("its_workpiece", kOptional),
    plan_row<&SurfaceTextureParameter::applied_to>("applied_to", kOptional),
};
constexpr Attribute kCurveWithNormalVector[] = {
    row<&CurveWithNormalVector::basiccurve>("basiccurve", kRequired),
    row<&CurveWithNormalVector::surface_normal>("surface_normal", kRequired),
};
constexpr Attribute kOrganization[] = {
    plan_row<&Organization::its_id>("its_id", kOptional),
    plan_row<&Organization::name>("name", kRequired),
    plan_row<&Organization::description>("description", kOptional),
};
constexpr Attribute kPersonAndOrganization[] = {
    plan_row<&PersonAndOrganization::its_person>("its_person", kRequired),
    plan_row<&PersonAndOrganization::its_organization>("its_organization", kRequired),
    plan_row<&PersonAndOrganization::description>("description", kOptional),
};
constexpr Attribute kApprovingPersonOrganization[] = {
    plan_row<&ApprovingPersonOrganization::person_organization>("person_organization", kRequired),
    plan_row<&ApprovingPersonOrganization::role>("role", kOptional),
};
constexpr Attribute kPersonOrganizationAssignment[] = {
    plan_row<&PersonOrganizationAssignment::assigned_person_organization>("assigned_person_organization",
                                                                          kRequired),
    plan_row<&PersonOrganizationAssignment::role>("role", kRequired),
};
constexpr Attribute kDateTimeAssignment[] = {
    plan_row<&DateTimeAssignment::assigned_date>("assigned_date", kRequired),
    plan_row<&DateTimeAssignment::role>("role", kOptional),
};
constexpr Attribute kLastModifiedTimestamp[] = {
    plan_row<&LastModifiedTimestamp::modified_by>("modified_by", kOptional),
};
constexpr Attribute kSecurityClassification[] = {
    plan_row<&SecurityClassification::name>("name", kRequired),
    plan_row<&SecurityClassification::purpose>("purpose", kOptional),
    plan_row<&SecurityClassification::security_level>("security_level", kRequired),
};

constexpr NounRow kRows[] = {
    {TypeId::kApproval, "APPROVAL", TypeId::kNone, false, true, kApproval},
    {TypeId::kApprovalStatus, "APPROVAL_STATUS", TypeId::kNone, false, true, kApprovalStatus},
    {TypeId::kDateAndTime, "DATE_AND_TIME", TypeId::kNone, false, true, kDateAndTime},
    {TypeId::kDate, "DATE", TypeId::kNone, true, true, kDate},
    {TypeId::kCalendarDate, "CALENDAR_DATE", TypeId::kDate, false, true, kCalendarDate},
    {TypeId::kOrdinalDate, "ORDINAL_DATE", TypeId::kDate, false, true, kOrdinalDate},
    {TypeId::kWeekOfYearAndDayDate, "WEEK_OF_YEAR_AND_DAY_DATE", TypeId::kDate, false, true,
     kWeekOfYearAndDayDate},
    {TypeId::kLocalTime, "LOCAL_TIME", TypeId::kNone, false, true, kLocalTime},
    {TypeId::kCoordinatedUniversalTimeOffset, "COORDINATED_UNIVERSAL_TIME_OFFSET", TypeId::kNone, false, true,
     kCoordinatedUniversalTimeOffset},
    {TypeId::kPerson, "PERSON", TypeId::kNone, false, true, kPerson},
    {TypeId::kAddress, "ADDRESS", TypeId::kNone, false, true, kAddress},
    {TypeId::kTolerancedLengthMeasure, "TOLERANCED_LENGTH_MEASURE", TypeId::kNone, false, true,
     kTolerancedLengthMeasure},
    {TypeId::kPlusMinusValue, "PLUS_MINUS_VALUE", TypeId::kNone, false, true, kPlusMinusValue},
    {TypeId::kLimitsAndFits, "LIMITS_AND_FITS", TypeId::kNone, false, true, kLimitsAndFits},
    {TypeId::kPersonAndAddress, "PERSON_AND_ADDRESS", TypeId::kNone, false, true, kPersonAndAddress},
    {TypeId::kPropertyParameter, "PROPERTY_PARAMETER", TypeId::kNone, true, true, kPropertyParameter},
    {TypeId::kDescriptiveParameter, "DESCRIPTIVE_PARAMETER", TypeId::kPropertyParameter, false, true,
     kDescriptiveParameter},
    {TypeId::kNumericParameter, "NUMERIC_PARAMETER", TypeId::kPropertyParameter, false, true,
     kNumericParameter},
    {TypeId::kSurfaceTextureParameter, "SURFACE_TEXTURE_PARAMETER", TypeId::kNone, false, true,
     kSurfaceTextureParameter},
    {TypeId::kCurveWithNormalVector, "CURVE_WITH_NORMAL_VECTOR", TypeId::kNone, false, true,
     kCurveWithNormalVector},
    {TypeId::kOrganization, "ORGANIZATION", TypeId::kNone, false, false, kOrganization},
    {TypeId::kPersonAndOrganization, "PERSON_AND_ORGANIZATION", TypeId::kNone, false, false,
     kPersonAndOrganization},
    {TypeId::kApprovingPersonOrganization, "APPROVING_PERSON_ORGANIZATION", TypeId::kNone, false, false,
     kApprovingPersonOrganization},
    {TypeId::kPersonOrganizationAssignment, "PERSON_ORGANIZATION_ASSIGNMENT", TypeId::kNone, false, false,
     kPersonOrganizationAssignment},
    {TypeId::kDateTimeAssignment, "DATE_TIME_ASSIGNMENT", TypeId::kNone, false, false, kDateTimeAssignment},
    {TypeId::kLastModifiedTimestamp, "LAST_MODIFIED_TIMESTAMP", TypeId::kDateTimeAssignment, false, false,
     kLastModifiedTimestamp},
    {TypeId::kSecurityClassification, "SECURITY_CLASSIFICATION", TypeId::kNone, false, false,
     kSecurityClassification},
};

}  // namespace

std::span<const NounRow> support_rows() { return kRows; }

}  // namespace capstan::model
