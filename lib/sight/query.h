/// What a query is made of beside its settings, for what opens files.
#ifndef SL_QUERY_H
#define SL_QUERY_H

#include "sightline/query.h"

/// What a query keeps until it ends.
typedef struct sli_query_owner {
    void *what;
    void (*destroy)(sl_context *context, void *what);
} sli_query_owner;

/// Gives it to the query.
void sli_query_own(sl_query *query, sli_query_owner owner);

/// Follows a change of the space that is asked, which keeps its outline itself. Settings stay.
void sli_query_space_changed(sl_context *context, sl_query *query, const sl_outline *outline);

#endif
