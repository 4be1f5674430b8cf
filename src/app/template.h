/* The problem files under problems/templates, as text. */
#ifndef VES_APP_TEMPLATE_H
#define VES_APP_TEMPLATE_H

#include <stdio.h>

typedef struct app_template {
    const char *name, *text;
} app_template;

extern const app_template app_templates[]; /* ends with a NULL name */

void app_template_title(const app_template *t, char *title, size_t size);

#endif
