// Exponential and logarithm in arithmetic that gives the same bits on every machine.
#pragma once

namespace ballflow::geometry {

/// e^x, wrong by less than 2e-16 of it. 0 below -746 and infinity above 709.8; between -708.4 and -746
/// results are subnormal and only as exact as these. Made of + - * only, unlike that of the C library.
double exponential(double x);

/// The natural logarithm of x, wrong by less than 3e-16 of it; of 0 it is minus infinity, of negative numbers
/// it is not a number. Made of + - * / only.
double logarithm(double x);

}  // namespace ballflow::geometry
