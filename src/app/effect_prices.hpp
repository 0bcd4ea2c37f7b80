#pragma once

#include "app/session.hpp"

namespace speculum {

// GPU milliseconds that an effect adds to a frame, one for each pair of frames; empty for an effect that nothing calls
// for or that cannot be left out.
using EffectPrice = std::vector<double>;

// Of all effects, in the order of EffectKind, for the frame that the session drew last: frames with the effect and
// without it in turn, `pairs` of them after one that is not counted. The session's settings are as before afterwards.
// Ends early, with fewer pairs, once an interrupt is requested.
std::vector<EffectPrice> effectPrices(Session& session, double time, int pairs);

}  // namespace speculum
