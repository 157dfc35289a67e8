// Angles in arithmetic that gives the same bits on every machine.
#pragma once

namespace ballflow::geometry {

inline constexpr double pi = 3.141592653589793;

/// The angle of (x, y) against the x axis, in (-pi, pi]; 0 for (0, 0). Made of + - * / only, wrong by less
/// than 1e-15: unlike that of the C library it does not differ between machines.
double arctangent(double y, double x);

/// The cosine of an angle in [0, pi], as exact and in the same arithmetic.
double cosine(double angle);

}  // namespace ballflow::geometry
