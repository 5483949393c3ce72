#include "grammar/rules.hpp"
