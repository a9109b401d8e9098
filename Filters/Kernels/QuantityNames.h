/**
 * Messages name quantities in braces, "raise {Reach}", so that each front end says them with its
 * own names: property, option, keyword. Braces that mean themselves are doubled, as in Python's
 * str.format(). A port of a filter is in braces with the blank before it, "the image{ on port 0}".
 */
#ifndef FlipFreeQuantityNames_h
#define FlipFreeQuantityNames_h

#include <map>
#include <string>

namespace FlipFree
{

/// What a front end calls quantities, by the properties of the VTK filters.
using QuantityNames = std::map<std::string, std::string>;

/// The message in the words of a front end. What it has no name for keeps that of the property. A
/// front end with names has no ports, and VTK's, without any, says them.
std::string WithNames(const std::string& message, const QuantityNames& names = {});

/// The message with those of its quantities that have words said in words, whatever the front end.
std::string WithWords(const std::string& message, const QuantityNames& words);

/// A text to be part of a message: its braces doubled.
std::string Escaped(const std::string& text);

} // namespace FlipFree

#endif
