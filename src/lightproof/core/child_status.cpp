#include "lightproof/core/child_status.h"

#include <csignal>
#include <mutex>

namespace lightproof {
namespace {

std::mutex mutex;
int users = 0;
struct sigaction before = {};

bool drops_status(const struct sigaction& action) {
  return action.sa_handler == SIG_IGN || (action.sa_flags & SA_NOCLDWAIT) != 0;
}

}  // namespace

ChildStatusKept::ChildStatusKept() {
  const std::lock_guard lock(mutex);
  if (users++ > 0) return;
  ::sigaction(SIGCHLD, nullptr, &before);
  if (!drops_status(before)) return;
  struct sigaction usual = {};
  usual.sa_handler = SIG_DFL;
  ::sigaction(SIGCHLD, &usual, nullptr);
}

ChildStatusKept::~ChildStatusKept() {
  const std::lock_guard lock(mutex);
  if (--users == 0 && drops_status(before)) ::sigaction(SIGCHLD, &before, nullptr);
}

}  // namespace lightproof
