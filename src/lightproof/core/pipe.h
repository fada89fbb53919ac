// A pipe between this process and a program that it starts.
#pragma once

#include <cstddef>
#include <string>

namespace lightproof {

/// Both ends of a pipe, which programs get only where they are handed over. Closed with this.
class Pipe {
 public:
  /// Throws InputError if the process may open no more files.
  Pipe();
  ~Pipe();
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int read_end() const { return read_end_; }
  int write_end() const { return write_end_; }

  /// Closes the end for writing here: it stays open where it was handed over.
  void close_write_end();

  /// Takes what lies in the pipe, at most so many bytes. Waits for nothing, as long as nobody else
  /// reads.
  std::string take(std::size_t most) const;

 private:
  int read_end_ = -1;
  int write_end_ = -1;
};

}  // namespace lightproof
