-- One exchange of the robot with its keys, atomic in Redis and in its append-only file.
-- KEYS: commands, queue, record, feedback, stream, reset, map, odom, fiducials, lidar, status
-- ARGV: owner, last entry number seen, how many to take, how many bytes of each, JSON of what to write (its highest
-- batch ``issued`` so far)
-- Returns {is still owner, resets so far, held, {entry, ...}} with entries as "number text".
local commands, queue, record, feedback, stream, reset = unpack(KEYS, 1, 6)
local map, odom, fiducials, lidar, status = unpack(KEYS, 7, 11)
local owner, seen, take, bytes = ARGV[1], tonumber(ARGV[2]), tonumber(ARGV[3]), tonumber(ARGV[4])
local news = cjson.decode(ARGV[5])
local SCAN_MAX = 20000
local AHEAD_MAX = 1e6  -- so many entries are never taken that the robot has not seen

-- A key that somebody made into something else is made anew.
local function must_be(key, kind)
    local found = redis.call('TYPE', key).ok
    if found ~= 'none' and found ~= kind then redis.call('DEL', key) end
end
must_be(commands, 'list') must_be(queue, 'list') must_be(record, 'hash') must_be(feedback, 'list')
must_be(stream, 'stream') must_be(reset, 'string') must_be(map, 'list')

-- Fields that somebody made into something else count as 0; what the robot knows better is put right.
local function field(name)
    local text = redis.call('HGET', record, name)
    return text and #text <= 15 and string.match(text, '^%d+$') and tonumber(text) or 0
end
local function put(name, number) redis.call('HSET', record, name, string.format('%.0f', number)) end
local function number_of(entry) return tonumber(string.match(entry, '^(%d+) ')) end

local holder = redis.call('HGET', record, 'owner')
if holder ~= owner then
    if holder and #holder == #owner and string.match(holder, '^%x+$') then return {0, 0, 0, {}} end
    redis.call('HSET', record, 'owner', owner)
end
local newest = number_of(redis.call('LINDEX', queue, -1) or '') or 0
if field('seq') < seen or field('seq') > seen + AHEAD_MAX then
    put('seq', newest > seen and newest <= seen + AHEAD_MAX and newest or seen)
end
if news.issued and field('batch') > news.issued then put('batch', 0) end

-- What the robot did, once: a batch whose answer was lost comes again under the same number.
local function end_entries(ended)
    local gone = {}
    for _, number in ipairs(ended) do gone[number] = true end
    for _, entry in ipairs(redis.call('LRANGE', queue, 0, -1)) do
        local number = number_of(entry)
        if not number or gone[number] then redis.call('LREM', queue, 1, entry) end
    end
end
local function say(text, fields)
    redis.call('RPUSH', feedback, text)
    local entry = {stream, 'MAXLEN', '~', news.stream_max, '*', unpack(fields)}
    if type(redis.pcall('XADD', unpack(entry))) == 'table' then  -- somebody used the last id there is
        redis.call('DEL', stream)
        redis.call('XADD', unpack(entry))
    end
end
for _, batch in ipairs(news.batches) do
    if batch.number > field('batch') then
        put('batch', batch.number)
        put('handled', batch.handled)
        put('resets_handled', batch.resets)
        if batch.state then redis.call('HSET', record, 'state', batch.state) end
        if #batch.ended > 0 then end_entries(batch.ended) end
        for i, text in ipairs(batch.feedback) do say(text, batch.fields[i]) end
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
    put('resets', field('resets') + 1)
end

-- Look at the whole backlog for a stop (each entry once), but take only so much of it.
local length, scanned, hold = redis.call('LLEN', commands), field('scanned'), field('hold')
if length < scanned or scanned < hold then scanned, hold = 0, 0 end
if length > 0 then
    local horizon = math.min(length, scanned + SCAN_MAX)
    for first = scanned, horizon - 1, 1000 do
        local last = math.min(first + 999, horizon - 1)
        for i, entry in ipairs(redis.call('LRANGE', commands, first, last)) do
            if string.find(entry, 'stop', 1, true) and not string.find(entry, 'patrol', 1, true) then
                hold = first + i
            end
        end
    end
    local count, number = math.min(length, take), field('seq')
    for _ = 1, count do
        number = number + 1
        local text = string.sub(redis.call('LPOP', commands), 1, bytes)
        redis.call('RPUSH', queue, string.format('%.0f ', number) .. text)
    end
    put('seq', number)
    hold = math.max(0, hold - count)
    put('scanned', math.max(0, horizon - count))
    put('hold', hold)
end

-- Everything in the robot's list that it has not seen: just taken, or taken by an exchange whose answer was lost.
local fresh, last = {}, redis.call('LINDEX', queue, -1)
if last and (number_of(last) or math.huge) > seen then
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
