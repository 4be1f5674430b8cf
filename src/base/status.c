#include "base/diag.h"

const char *ves_status_text(ves_status status)
{
    switch (status) {
#define VES_STATUS_CASE(name, value, sentence)                                                               \
    case VES_##name:                                                                                         \
        return sentence;
        VES_STATUS_LIST(VES_STATUS_CASE)
#undef VES_STATUS_CASE
    }
    return "unknown status";
}

const char *ves_status_word(ves_status status)
{
    switch (status) {
#define CASE(name, value, sentence)                                                                          \
    case VES_##name:                                                                                         \
        return #name;
        VES_STATUS_LIST(CASE)
#undef CASE
    }
    return "FAULT";
}
