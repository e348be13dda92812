/* Variance of blocks of pixels of the counting model from the geometry of its grids alone, without drawing a count. */
#ifndef TESTS_GRID_TRUTH_H
#define TESTS_GRID_TRUTH_H

/* What facet_overlap is for explicit facets: the mean of k x k pixels of split x split samples has, relative to its
 * mean, the variance (1 - p) / p times this. jacobian: dudx, dudy, dvdx, dvdy of a pixel in metres.
 *
 * Grid i draws the share t_i of the facets: cell c gives, relative to the mean, t_i S_c X / (t_i N' p), S_c the weight
 * that the samples of the block give it, X one of three corners with weights v. Var X = t_i N' p (1 - p), E sum v^2 =
 * 1/2 and N' = N / 2, so the variance is (1 - p) / (N p) sum_i t_i E sum_c S_c^2; the expectation is over where the
 * grid lies. N counts the facets under the footprint convolved with half a facet. */
double grid_overlap(int k, int split, const double jacobian[4], double facets_per_m2);

#endif
