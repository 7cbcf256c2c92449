#pragma once

namespace sphparam {

/// Time against distortion, for methods that minimise it. No map has folds, whatever the quality.
enum class Quality {
  Draft,   // relaxed sweeps, Newton steps on coarse levels only: within 1 % of the least energy on
           // ordinary shapes, 20 % on long protrusions
  Normal,  // within 1 %, on tubes of 100:1 within 15 %: Newton steps where their gain pays
  Best,    // converged; on shapes with protrusions the lowest of up to five starts, until two agree
};

/// What a map gives up for what.
enum class Balance {
  Lambda,     // as energy.lambda says
  Conformal,  // angles, whatever the areas: λ towards 0 as long as the mean angle error falls
  EqualArea,  // areas within `area_error`, then angles: the least λ that does it
};

}  // namespace sphparam
