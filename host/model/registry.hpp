// What the generated files (one per model, and the registry) share.
#pragma once

#include "model/model.hpp"
#include "model/observable.hpp"
