// Upper tails of the distributions that the gate judges by, as logarithms: a p-value is never
// rounded to 0, however small. Boost.Math where its doubles reach, continued fractions and series
// beyond. What is not a number has a tail that is none either: it is never taken for a pass.
#pragma once

namespace lightproof {

/// log10 P(chi-square with `dof` degrees of freedom >= statistic). dof > 0; a statistic that
/// rounding has left below 0 counts as 0.
double log10_chi_square_tail(double statistic, double dof);

/// log10 P(chi-square < statistic): small where counts agree better than chance allows;
/// -infinity at a statistic of 0.
double log10_chi_square_lower(double statistic, double dof);

/// log10 P(Poisson count of this mean <= count). mean > 0.
double log10_poisson_lower(double count, double mean);

/// log10 P(Poisson count of this mean >= count). mean > 0.
double log10_poisson_upper(double count, double mean);

/// The mean at which a Poisson count is at least `count` (>= 1) with this probability.
double poisson_mean_reaching(double count, double probability);

/// log10 P(|standard normal| >= |z|).
double log10_normal_tails(double z);

/// The non-centrality at which a chi-square test of size alpha rejects with the given power.
double minimum_detectable_noncentrality(double dof, double alpha, double power);

/// The non-centrality at which chi-square of `dof` degrees of freedom exceeds `critical` with the
/// given probability.
double noncentrality_beyond(double dof, double critical, double probability);

/// P(a chi-square test of size alpha and `dof` degrees of freedom rejects) at this non-centrality.
double chi_square_power(double dof, double alpha, double noncentrality);

/// P(standard normal <= z).
double normal_cdf(double z);

/// The z with P(standard normal <= z) = probability.
double normal_quantile(double probability);

/// P(Student's t with `dof` degrees of freedom >= t). 0 at infinity.
double student_upper(double t, double dof);

/// The deviation of a mean in standard errors at which a two-sided z-test of size alpha rejects
/// with the given power.
double minimum_detectable_z(double alpha, double power);

}  // namespace lightproof
