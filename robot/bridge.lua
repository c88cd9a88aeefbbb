-- One exchange of the robot with its keys, atomic in Redis and in its append-only file.
-- KEYS: commands, queue, record, feedback, stream, reset, map, odom, fiducials, lidar, status
-- ARGV: owner, last entry number seen, how many to take, how many bytes of each, JSON of what to write
-- Returns {is still owner, resets so far, held, {entry, ...}} with entries as "number text".
local commands, queue, record, feedback, stream, reset = unpack(KEYS, 1, 6)
local map, odom, fiducials, lidar, status = unpack(KEYS, 7, 11)
local owner, seen, take, bytes = ARGV[1], tonumber(ARGV[2]), tonumber(ARGV[3]), tonumber(ARGV[4])
local news = cjson.decode(ARGV[5])
local SCAN_MAX = 20000

-- A key that somebody made into something else is made anew.
local function must_be(key, kind)
    local found = redis.call('TYPE', key).ok
    if found ~= 'none' and found ~= kind then redis.call('DEL', key) end
end
must_be(commands, 'list') must_be(queue, 'list') must_be(record, 'hash') must_be(feedback, 'list')
must_be(stream, 'stream') must_be(reset, 'string') must_be(map, 'list')

local function field(name) return tonumber(redis.call('HGET', record, name) or 0) or 0 end
local function number_of(entry) return tonumber(string.match(entry, '^(%d+) ')) end

local holder = redis.call('HGET', record, 'owner')
if holder and holder ~= owner then return {0, 0, 0, {}} end
if not holder then redis.call('HSET', record, 'owner', owner) end
if field('seq') < seen then redis.call('HSET', record, 'seq', seen) end

-- What the robot did, once: a batch whose answer was lost comes again under the same number.
local function end_entries(ended)
    local gone = {}
    for _, number in ipairs(ended) do gone[number] = true end
    for _, entry in ipairs(redis.call('LRANGE', queue, 0, -1)) do
        local number = number_of(entry)
        if not number or gone[number] then redis.call('LREM', queue, 1, entry) end
    end
end
for _, batch in ipairs(news.batches) do
    if batch.number > field('batch') then
        redis.call('HSET', record, 'batch', batch.number, 'handled', batch.handled, 'resets_handled', batch.resets)
        if batch.state then redis.call('HSET', record, 'state', batch.state) end
        if #batch.ended > 0 then end_entries(batch.ended) end
        for i, text in ipairs(batch.feedback) do
            redis.call('RPUSH', feedback, text)
            redis.call('XADD', stream, 'MAXLEN', '~', news.stream_max, '*', unpack(batch.fields[i]))
        end
        if #batch.feedback > 0 then redis.call('LTRIM', feedback, -news.feedback_max, -1) end
        if batch.map then
            redis.call('RPUSH', map, batch.map)
            redis.call('LTRIM', map, -news.map_max, -1)
        end
    end
end
if news.odom then redis.call('SET', odom, news.odom) end
if news.fiducials then redis.call('SET', fiducials, news.fiducials) end
if news.lidar then redis.call('SET', lidar, news.lidar) end
if news.status then redis.call('SET', status, news.status, 'EX', news.status_expiry) end

if redis.call('GET', reset) == '1' then
    redis.call('DEL', commands, queue, feedback, stream, map, odom, fiducials, lidar, status)
    redis.call('SET', reset, '0')
    redis.call('HINCRBY', record, 'resets', 1)
end

-- Look at the whole backlog for a stop (each entry once), but take only so much of it.
local length, scanned, hold = redis.call('LLEN', commands), field('scanned'), field('hold')
if length > 0 or scanned > 0 then
    if length < scanned then scanned, hold = 0, 0 end
    local horizon = math.min(length, scanned + SCAN_MAX)
    for first = scanned, horizon - 1, 1000 do
        local last = math.min(first + 999, horizon - 1)
        for i, entry in ipairs(redis.call('LRANGE', commands, first, last)) do
            if string.find(entry, 'stop', 1, true) and not string.find(entry, 'patrol', 1, true) then
                hold = first + i
            end
        end
    end
    local count = math.min(length, take)
    for _ = 1, count do
        local number = redis.call('HINCRBY', record, 'seq', 1)
        redis.call('RPUSH', queue, number .. ' ' .. string.sub(redis.call('LPOP', commands), 1, bytes))
    end
    hold = math.max(0, hold - count)
    redis.call('HSET', record, 'scanned', math.max(0, horizon - count), 'hold', hold)
end

-- Everything in the robot's list that it has not seen: just taken, or taken by an exchange whose answer was lost.
local fresh, newest = {}, redis.call('LINDEX', queue, -1)
if newest and (number_of(newest) or math.huge) > seen then
    local seq = field('seq')
    for _, entry in ipairs(redis.call('LRANGE', queue, 0, -1)) do
        local number = number_of(entry)
        if not number or number > seq then
            redis.call('LREM', queue, 1, entry)
        elseif number > seen then
            fresh[#fresh + 1] = entry
        end
    end
end
return {1, field('resets'), hold, fresh}
