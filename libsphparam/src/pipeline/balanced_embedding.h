#pragma once

#include <vector>

#include "embedding/frame/landmarks.h"
#include "pipeline/map_in_progress.h"

namespace sphparam {

/// The progressive embedding around the pins, then, where λ is far from 1 or to be found, its
/// balance of angles and areas; `work.energy` gets the λ that it found. False: the embedding ran
/// out of room, and nothing has changed but `work.tried_to_embed`. True: its map is the map so far,
/// certified or not. Of a certified map so far, made without them, the pins may keep its folds.
bool embed(MapInProgress& work, const std::vector<Pin>& pins);

/// Presses fillers that take more of the sphere than they may, pins where they are. False: none
/// does, and the map stays. True: no energy gap is known any more.
bool press_fillers_again(MapInProgress& work, SphereMap& map, const std::vector<Pin>& pins);

/// Brings areas that poles have moved back to the balance, pins where they are. False: there is
/// none to bring them to, or nothing to gain, and the map stays.
bool balance_again(MapInProgress& work, SphereMap& map, const std::vector<Pin>& pins);

/// Mean |log2 area ratio|, fillers included.
double area_error_of(MapInProgress& work, const SphereMap& map);

/// Warns where the map is not what the balance asked for promises, with the figure it reached:
/// `work.result.balance` gets that of the finished map.
void warn_of_balance(MapInProgress& work);

/// Warns where steps have left more of the energy than is the greatest for the quality.
void warn_of_gap(MapInProgress& work);

/// `work.result.filler_share` is that of the finished map; warns where it is more than was asked
/// for.
void tell_filler_share(MapInProgress& work);

}  // namespace sphparam
