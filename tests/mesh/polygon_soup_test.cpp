#include "delmesh/mesh/polygon_soup.hpp"
#include <gtest/gtest.h>
