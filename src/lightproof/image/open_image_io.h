// OpenImageIO, included in the order that works. Private to the image module. OpenImageIO brings a
// copy of fmt, header-only and without exceptions; whichever fmt is seen first is the one that a
// source file uses, and it must be the library that is linked.
#pragma once

#include <fmt/format.h>

// Kept apart: sorted together, the order would be lost.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
