// Every system of the four documents that Lightproof covers, in one table.
#pragma once

#include <span>
#include <string_view>

namespace lightproof {

/// The documents, by the number that a system's begins with.
struct SourceDocument {
  std::string_view number;  ///< "002"
  std::string_view title;
};

std::span<const SourceDocument> source_documents();

struct SystemInfo {
  std::string_view id;    ///< "004-7": the document and a number in it
  std::string_view name;  ///< what it is, in one line
  /// GoogleTest's name of a test that covers it, "Suite.Name".
  std::string_view test;
  /// The document's formula is lost or only named: the form here is the field's, and no form of it
  /// is ever called published.
  bool is_inferred = false;
};

/// In the order of their ids.
std::span<const SystemInfo> systems();

/// The title of the document that the system stands in.
std::string_view document_of(const SystemInfo& system);

}  // namespace lightproof
