// The C locale of this program speaks UTF-8 on Windows too. There the library turns every name of a file from
// `char` into UTF-16 by these functions, which ask the C library of Windows for the code page of the machine.
// They are the part of libstdc++ that each system defines for itself: what is linked first is taken, and has
// to be all five.
#include <codecvt>
#include <locale>

namespace {

const std::codecvt_utf8_utf16<wchar_t>& utf8() {
  static const std::codecvt_utf8_utf16<wchar_t> one;
  return one;
}

}  // namespace

namespace std {

using OfNames = codecvt<wchar_t, char, mbstate_t>;

codecvt_base::result OfNames::do_in(state_type& state, const char* from, const char* from_end,
                                    const char*& from_next, wchar_t* to, wchar_t* to_end,
                                    wchar_t*& to_next) const {
  return utf8().in(state, from, from_end, from_next, to, to_end, to_next);
}

codecvt_base::result OfNames::do_out(state_type& state, const wchar_t* from, const wchar_t* from_end,
                                     const wchar_t*& from_next, char* to, char* to_end,
                                     char*& to_next) const {
  return utf8().out(state, from, from_end, from_next, to, to_end, to_next);
}

int OfNames::do_length(state_type& state, const char* from, const char* end, size_t most) const {
  return utf8().length(state, from, end, most);
}

int OfNames::do_encoding() const noexcept { return utf8().encoding(); }

int OfNames::do_max_length() const noexcept { return utf8().max_length(); }

}  // namespace std
