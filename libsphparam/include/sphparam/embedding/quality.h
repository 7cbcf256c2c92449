#pragma once

namespace sphparam {

/// Time against distortion, for methods that minimise it. No map has folds, whatever the quality.
enum class Quality {
  Draft,   // within 5 % of the least energy: relaxed sweeps, Newton steps on coarse levels, and of
           // shapes with protrusions a few on the finest, where the mesh is small or they pay
  Normal,  // within 1 %: Newton steps where their gain pays, and of shapes that cannot but be much
           // distorted another start or two. Where more is left both go on as Best, for a while
  Best,    // converged; of shapes that cannot but be distorted, and where only the finest level
           // needs Newton steps, the lowest of several starts
};

/// What a map gives up for what.
enum class Balance {
  Lambda,     // as energy.lambda says
  Conformal,  // angles: the λ at which areas weigh next to nothing of what the angles still miss
  EqualArea,  // areas within `area_error`, then angles: the least λ of 4, 16, …, else of 4, 8, …
};

}  // namespace sphparam
