#include "frontend/check.hpp"
