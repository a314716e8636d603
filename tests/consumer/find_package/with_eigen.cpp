#include <viete/sym3/eigen.h>

static_assert(sizeof(viete::sym3::to_eigen(viete::sym3::Sym3<double>{})) == 9 * sizeof(double));
