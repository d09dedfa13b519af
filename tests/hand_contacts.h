/* Contacts written by hand into a snapshot. */
#pragma once

#include "hand_folder.h"

#include "model/snapshot.h"

static inline void hand_contact(OzSnapshot *snapshot, OzContactEntry entry)
{
    assert_int_equal(oz_contact_list_add(&snapshot->contacts, &entry), OZ_OK);
    oz_contact_list_sort(&snapshot->contacts);
    snapshot->has_contacts = true;
}
