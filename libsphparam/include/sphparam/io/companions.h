#pragma once

namespace sphparam {

/// For programs that end with what they were called for: from now on `keep_companions` keeps what
/// meshes name from being replaced, as long as the process runs. Until then it does nothing, as who
/// uses the library may write anew what was read before.
void guard_companions();

}  // namespace sphparam
