#include "engine/engine.hpp"  // checks that the interface stands on its own
