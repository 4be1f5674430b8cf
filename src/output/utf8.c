#include "output/utf8.h"

#include <stdbool.h>
#include <string.h>

int ves_utf8_length(const char *text)
{
    const unsigned char *s = (const unsigned char *)text;
    if (s[0] < 0x80) return 1;
    int length = s[0] >= 0xF5 ? 0 : s[0] >= 0xF0 ? 4 : s[0] >= 0xE0 ? 3 : s[0] >= 0xC2 ? 2 : 0;
    for (int k = 1; k < length; k++)
        if ((s[k] & 0xC0) != 0x80) return 0;
    bool overlong = (s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xF0 && s[1] < 0x90);
    bool outside = (s[0] == 0xED && s[1] >= 0xA0) || (s[0] == 0xF4 && s[1] >= 0x90);
    return overlong || outside ? 0 : length;
}

void ves_utf8_copy(char *copy, size_t size, const char *text)
{
    size_t at = 0;
    while (text && *text) {
        int length = ves_utf8_length(text), taken = length ? length : 1;
        if (at + (size_t)taken >= size) break;
        if (length)
            memcpy(copy + at, text, (size_t)length);
        else
            copy[at] = '?';
        at += (size_t)taken;
        text += taken;
    }
    copy[at] = 0;
}
