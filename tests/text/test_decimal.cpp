#include <gmock/gmock.h>

#include "text/decimal.hpp"
#include "text/nearest_name.hpp"

namespace pelagos {
namespace {

using testing::HasSubstr;

TEST(Decimal, ReadsNumbersAsWritten) {
  EXPECT_EQ(read_decimal("010"), 10.0);
  EXPECT_EQ(read_decimal("-090.5"), -90.5);
  EXPECT_EQ(read_decimal("+7"), 7.0);
  EXPECT_EQ(read_decimal(".5"), 0.5);
  EXPECT_EQ(read_decimal("5."), 5.0);
  EXPECT_EQ(read_decimal("08e1"), 80.0);
  EXPECT_EQ(read_decimal("1E-3"), 1e-3);
  EXPECT_EQ(read_decimal("00"), 0.0);
  EXPECT_EQ(read_decimal("1e-999"), 0.0);
}

TEST(Decimal, ReadsNothingElse) {
  for (const char* text : {"", "-", ".", "e5", "0,5", "0x10", "nan", "-inf", "Infinity", "1e999", "5m", "1 000", " 5",
                           "5 ", "1..2", "1e", "--5", "−5", "５"})
    EXPECT_EQ(read_decimal(text), std::nullopt) << text;
}

TEST(Decimal, SaysWhatIsWrong) {
  EXPECT_EQ(fault_of_number("0,5", NumberKind::kReal), "a decimal comma; write 0.5");
  EXPECT_EQ(fault_of_number("0,5", NumberKind::kWhole), "not a whole number");
  EXPECT_EQ(fault_of_number("12kn", NumberKind::kReal), "\"kn\" follows the number; write 12");
  EXPECT_EQ(fault_of_number("NaN", NumberKind::kReal), "not finite");
  EXPECT_EQ(fault_of_number("0X1f", NumberKind::kReal), "hexadecimal");
  EXPECT_EQ(fault_of_number("", NumberKind::kWhole), "empty");
  EXPECT_EQ(fault_of_number("five", NumberKind::kWhole), "no number");
  EXPECT_EQ(fault_of_number("1.5", NumberKind::kWhole), "not a whole number");
  EXPECT_EQ(fault_of_number("-1", NumberKind::kNotNegative), "negative");
  EXPECT_EQ(fault_of_number("-0", NumberKind::kNotNegative), "");
  EXPECT_THAT(fault_of_number("−5", NumberKind::kReal), HasSubstr("minus sign, U+2212); write - instead"));
  EXPECT_THAT(fault_of_number("5\u00A0", NumberKind::kReal), HasSubstr("no-break space"));
}

TEST(Decimal, TakesZerosInFrontAway) {
  EXPECT_EQ(without_leading_zeros("010"), "10");
  EXPECT_EQ(without_leading_zeros("-00.5"), "-0.5");
  EXPECT_EQ(without_leading_zeros("+007"), "7");
  EXPECT_EQ(without_leading_zeros("000"), "0");
  EXPECT_EQ(without_leading_zeros(".5"), ".5");
}

}  // namespace
}  // namespace pelagos
