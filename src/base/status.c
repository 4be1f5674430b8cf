#include "vesica/status.h"

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
