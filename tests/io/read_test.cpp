#include "io/io_support.hpp"
