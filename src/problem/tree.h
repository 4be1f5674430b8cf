/* Tree: what YAML makes of a problem file. Every node knows its place in the text, so that later errors can
 * point at it. */
#ifndef VES_PROBLEM_TREE_H
#define VES_PROBLEM_TREE_H

#include "problem/script.h"

enum { VES_TREE_DEPTH = 64, VES_TREE_NODES = 300000 };

typedef enum ves_node_kind { VES_NODE_WORD, VES_NODE_LIST, VES_NODE_MAP } ves_node_kind;

typedef struct ves_node ves_node;
struct ves_node {
    ves_node_kind kind;
    bool plain;            /* WORD: not quoted */
    bool flow;             /* LIST, MAP: in brackets */
    bool alias;            /* stands here through *name */
    bool repeat;           /* a key that its mapping has already */
    const char *text;      /* WORD */
    int count;             /* LIST: items, MAP: pairs */
    int repeats;           /* MAP: pairs after those, whose keys were given before; the reader complains */
    const ves_node **key;  /* MAP: words */
    const ves_node **item; /* LIST: items, MAP: values */
    size_t begin, end;     /* bytes of the text as run */
    size_t exact; /* WORD: where its text stands byte by byte; (size_t)-1 when it is spread or escaped */
    size_t token, token_end; /* what --set replaces: as begin, end; of an alias the *name */
    int weight;              /* nodes below, aliases counted each time */
};

/* Reads the script's text. Every fault of the text is in diag; *root is NULL then. */
ves_status ves_tree_read(const ves_script *script, ves_arena *arena, const ves_node **root, ves_diag *diag);

/* The mark of a whole node; a block that spans lines is marked at its first byte. */
ves_mark ves_node_mark(const ves_script *script, const ves_node *node);

/* The value of a key, or NULL. */
const ves_node *ves_node_find(const ves_node *map, const char *key);

/* Does any value below contain the word, as a whole word? */
bool ves_node_mentions(const ves_node *node, const char *word);

#endif
