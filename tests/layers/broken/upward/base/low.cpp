#include "grammar/high.hpp"
