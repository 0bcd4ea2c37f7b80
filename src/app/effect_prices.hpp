#pragma once

#include "app/session.hpp"

namespace speculum {

// GPU milliseconds that an effect adds to a frame, one value for each pair of frames. Empty for an effect that nothing
// calls for or that cannot be left out.
using EffectPrice = std::vector<double>;

// Measures all effects, in the order of EffectKind, for the frame that the session drew last: draws frames with and
// without the effect in turn, `pairs` of them after one that is not counted. Restores the session's settings.
// Ends early, with fewer pairs, once an interrupt is requested.
std::vector<EffectPrice> effectPrices(Session& session, double time, int pairs);

}  // namespace speculum
