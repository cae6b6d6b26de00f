#pragma once

namespace spring_workbench::validation {

/// Closes all files of this process except the standard streams and `file`. Throws if they cannot be listed.
void keep_alone(int file);

/// From now on, this process cannot open sockets, write files, start programs or affect other processes: these calls
/// fail with EPERM. Returns false if the kernel or the processor does not support such a filter; the process then only
/// cannot gain privileges (PR_SET_NO_NEW_PRIVS).
[[nodiscard]] bool confine();

}  // namespace spring_workbench::validation
