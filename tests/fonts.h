/* fontconfig keeps what it has read about the fonts until the process ends, and nothing of it points there:
 * for tests that draw pictures under the leak sanitizer. One file of a program includes this. */
#ifndef TESTS_FONTS_H
#define TESTS_FONTS_H

const char *__lsan_default_suppressions(void);
const char *__asan_default_options(void);

const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig\n";
}

const char *__asan_default_options(void)
{
    return "print_suppressions=0"; /* what counts as a finding is that a log is there */
}

#endif
