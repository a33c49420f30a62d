// `phyllite recipe`: what every key means, a template, the reference page. All of it comes from the schema.
#pragma once
#include <string>

namespace phy::cli {

/// Meaning, allowed values, default, units and PFC name of a key: "theta", "bedding.theta",
/// "bedding[0].theta" as in messages, or PFC's name of it. A key of several tables is explained once for
/// each. Throws InputError if unknown.
std::string explain(const std::string& key);
/// All keys as a Markdown page (docs/reference.md).
std::string reference_markdown();
/// A complete recipe with comments: the paper's specimen with one set of bedding.
std::string template_recipe();

}  // namespace phy::cli
