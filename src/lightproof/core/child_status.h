// How children of this process ended, kept for whoever waits for them.
#pragma once

namespace lightproof {

/// Where SIGCHLD is ignored, as some launchers leave it, the system forgets how a child ended.
/// While any of these lives it is not ignored.
class ChildStatusKept {
 public:
  ChildStatusKept();
  ~ChildStatusKept();
  ChildStatusKept(const ChildStatusKept&) = delete;
  ChildStatusKept& operator=(const ChildStatusKept&) = delete;
};

}  // namespace lightproof
