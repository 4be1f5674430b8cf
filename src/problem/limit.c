/* Ranges and numbers in words. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "problem/problem.h"

void ves_number_text(double value, char text[32])
{
    snprintf(text, 32, "%.12g", value);
}

void ves_quantity_text(double value, ves_dim dim, bool units, char text[VES_QUANTITY])
{
    char number[32], unit[48];
    bool plain = !units || dim.any || (!dim.m && !dim.kg && !dim.s);
    ves_number_text(value, number);
    ves_dim_text(dim, unit);
    snprintf(text, VES_QUANTITY, "%s%s%s", number, plain ? "" : " ", plain ? "" : unit);
}

void ves_limit_text(double least, double most, char text[96])
{
    char low[32], high[32];
    ves_number_text(least, low);
    ves_number_text(most, high);
    bool above = !isinf(least), below = !isinf(most);
    text[0] = 0;
    if (least == VES_POSITIVE)
        strcat(strcat(strcat(text, "> 0"), below ? " and <= " : ""), below ? high : "");
    else if (above && below)
        strcat(strcat(strcat(strcat(strcat(text, "in ["), low), ", "), high), "]");
    else
        strcat(strcat(text, above ? ">= " : "<= "), above ? low : high);
}
