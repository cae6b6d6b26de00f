#pragma once

namespace spring_workbench::validation {

/// Closes all files of this process except the standard streams and `file`. Throws if they cannot be listed.
void keep_alone(int file);

/// From now on this process opens no socket, writes no file, starts no program and touches no other process: these
/// calls fail with EPERM. Returns false if the kernel or the processor's kind offers no such filter; the process then
/// only gains no privileges (PR_SET_NO_NEW_PRIVS).
[[nodiscard]] bool confine();

}  // namespace spring_workbench::validation
