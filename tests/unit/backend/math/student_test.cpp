#include "backend/math/student.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace scenec::backend {
namespace {

// Closed forms: one degree of freedom is Cauchy's distribution; two have an algebraic one.
double cauchy(double t) {
  return 2 / std::numbers::pi * std::atan2(1, t);
}
double two(double t) {
  const double root = std::sqrt(2 + t * t);
  return 2 / (root * (root + t));
}

TEST(Student, HoldsTheClosedForms) {
  for (const double t : {1e-6, 0.1, 0.5, 1.0, 2.0, 3.7, 10.0, 1e3, 1e8}) {
    EXPECT_NEAR(log_student_tail(t, 1), std::log(cauchy(t)), 1e-10) << t;
    EXPECT_NEAR(log_student_tail(t, 2), std::log(two(t)), 1e-10) << t;
  }
}

TEST(Student, HoldsTheTables) {
  // Two-sided 5 % and 1 % points.
  EXPECT_NEAR(std::exp(log_student_tail(3.182446305, 3)), 0.05, 1e-9);
  EXPECT_NEAR(std::exp(log_student_tail(2.228138852, 10)), 0.05, 1e-9);
  EXPECT_NEAR(std::exp(log_student_tail(2.660283029, 60)), 0.01, 1e-9);
  // Many degrees of freedom: the normal distribution, far out too.
  EXPECT_NEAR(std::exp(log_student_tail(1.959963985, 1e9)), 0.05, 1e-7);
  EXPECT_NEAR(log_student_tail(20, 1e9), -203.22397, 1e-4);
}

TEST(Student, FallsWithT) {
  for (const double freedom : {0.7, 3.0, 29.5, 1e4}) {
    double last = 0;
    for (double t = 0.01; t < 1e4; t *= 1.1) {
      const double now = log_student_tail(t, freedom);
      EXPECT_LT(now, last) << t << " " << freedom;
      last = now;
    }
  }
}

TEST(Student, AnswersWhereThereIsNothingToTest) {
  EXPECT_EQ(log_student_tail(0, 3), 0);
  EXPECT_EQ(log_student_tail(std::nan(""), 3), 0);
  EXPECT_EQ(log_student_tail(1, 0), 0);
  EXPECT_EQ(log_student_tail(std::numeric_limits<double>::infinity(), 3),
            -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace scenec::backend
