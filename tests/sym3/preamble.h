// Matrices and short names used by most tests here.
#pragma once

#include <doctest/doctest.h>

#include "bench/ensembles.h"
#include "sym3/sym3.h"

namespace viete::test {

using namespace bench::ensembles;
using sym3::Sym3;

}  // namespace viete::test

using namespace viete;
using namespace viete::test;
